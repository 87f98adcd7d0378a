#include "body/elements/sweep_kernel.hpp"

namespace ricochet {

template void kick_and_drift<1>(Motion<1>&, const Elements&, const Lane<1>&, const Lane<1>&);
template void kick_and_drift<2>(Motion<2>&, const Elements&, const Lane<2>&, const Lane<2>&);
template void kick_and_drift<4>(Motion<4>&, const Elements&, const Lane<4>&, const Lane<4>&);

}  // namespace ricochet
