#include "design/problem/map_table.h"

#include "design/problem/regrid.h"

namespace evenglow::design {

core::CellField MapTable::over(const core::CellGrid& grid) const {
  core::CellField field(
      core::CellGrid::over(nx, ny, grid.x0, grid.y0, grid.x0 + grid.nx * grid.dx, grid.y0 + grid.ny * grid.dy), 0.0);
  field.values = values;
  return regrid(field, grid);
}

}  // namespace evenglow::design
