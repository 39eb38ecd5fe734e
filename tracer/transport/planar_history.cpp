#include "tracer/transport/planar_history.h"

namespace evenglow::tracer {

template class BasicPlanarHistory<MeridianLight, NoArrivalObserver>;
template class BasicPlanarHistory<MeridianLight, NoArrivalObserver, PlanarDots>;

}  // namespace evenglow::tracer
