// The sweep in more lanes than the program has.

#include "body/springs/sweep_kernel.hpp"

namespace ricochet {

template void kick_and_drift<2, 8>(Motion<8>&, const Springs&, const Lane<8>&, const Lane<8>&);

}  // namespace ricochet
