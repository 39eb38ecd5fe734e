#include "tracer/transport/planar_history.h"

/// Apart from the others: so that how those are compiled does not depend on this one.
namespace evenglow::tracer {

template class BasicPlanarHistory<MeridianLight, NoArrivalObserver, PlanarDots>;

}  // namespace evenglow::tracer
