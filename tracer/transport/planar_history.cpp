#include "tracer/transport/planar_history.h"

namespace evenglow::tracer {

template class BasicPlanarHistory<MeridianLight, NoArrivalObserver>;

}  // namespace evenglow::tracer
