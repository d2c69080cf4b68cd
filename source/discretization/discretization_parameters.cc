#include <scree/discretization/discretization_parameters.h>

namespace scree
{
void
DiscretizationParameters::declare(ParameterSection &section)
{
  section.entry("Degree", degree, dealii::Patterns::Integer(1, 2),
                "Polynomial degree k of the displacement.");
  section.entry("Level set degree", level_set_degree,
                EnumNames<int>{{as_displacement, "as displacement"}, {1, "1"}, {2, "2"}},
                "Polynomial degree of the level sets in a cell, which cut it and give the gaps.");
  section.entry("Bulk Gauss points", gauss.bulk, dealii::Patterns::Integer(0, 4),
                "Per direction of a cell, or of the parts of a cut cell; 0: Degree + 1.");
  section.entry("Surface Gauss points", gauss.surface, dealii::Patterns::Integer(0, 4),
                "The same on the surface of a body in a cell, and between two bodies: points of "
                "boundary conditions and of contact; 0: Degree + 1.");
  section.entry("Ghost penalty", ghost_penalty, dealii::Patterns::Double(0., 1.),
                "gamma of the ghost penalty on faces of cut cells, 0.01 to 0.1; no "
                "dimension.");
}
} // namespace scree
