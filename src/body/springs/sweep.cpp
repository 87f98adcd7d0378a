#include "body/springs/sweep_kernel.hpp"

namespace ricochet {

template void kick_and_drift<2, 1>(Motion<1>&, const Springs&, const Lane<1>&, const Lane<1>&);
template void kick_and_drift<2, 2>(Motion<2>&, const Springs&, const Lane<2>&, const Lane<2>&);
template void kick_and_drift<2, 4>(Motion<4>&, const Springs&, const Lane<4>&, const Lane<4>&);

}  // namespace ricochet
