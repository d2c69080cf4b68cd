#include <scree/contact/contact_normal.h>
#include <scree/contact/surface_fit.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace scree
{
template <int dim>
bool
is_smooth(const Lattice<dim> &level_set, const dealii::Point<dim> &x)
{
  const auto                  &frame = level_set.frame();
  typename Lattice<dim>::Index first;
  for (unsigned int d = 0; d < dim; ++d)
    {
      first[d] = static_cast<int>(std::floor((x[d] - frame.origin[d]) / frame.spacing));
      if (first[d] - 1 < level_set.lower()[d]
          || first[d] + 2 >= level_set.lower()[d] + level_set.n_nodes()[d])
        return false;
    }
  double change = 0., unevenness = 0.;
  for (unsigned int d = 0; d < dim; ++d)
    for (unsigned int line = 0; line < 1u << (dim - 1); ++line)
      {
        typename Lattice<dim>::Index node = first;
        for (unsigned int e = 0; e < dim - 1; ++e)
          node[(d + 1 + e) % dim] += line >> e & 1;
        std::array<double, 4> phi;
        --node[d];
        for (double &value : phi)
          {
            value = level_set(node);
            ++node[d];
          }
        const double first_bend  = (phi[0] - 2. * phi[1] + phi[2]) / frame.spacing,
                     second_bend = (phi[1] - 2. * phi[2] + phi[3]) / frame.spacing;
        change                   = std::max(change, std::abs(first_bend + second_bend));
        unevenness               = std::max(unevenness, std::abs(first_bend - second_bend));
      }
  return change <= 1.2 && unevenness <= 0.02 + 0.3 * change;
}

namespace
{
/** What a body tells of the normal at a point. */
template <int dim>
struct Side
{
  Side(const ExactDistances<dim> &distances, const std::vector<Body<dim>> &bodies,
       const unsigned int body, const dealii::Point<dim> &x, const double size)
  {
    const Lattice<dim> &lattice = bodies[body].level_set;
    is_exact                    = distances.is_known(body, x);
    if (is_exact)
      {
        const double             reach = std::abs(distances.value(body, x)) + 1.5 * size;
        dealii::BoundingBox<dim> box({x, x});
        box.extend(reach);
        is_kinked = distances.is_kinked(body, box);
      }
    else
      is_kinked = !is_smooth(lattice, x);
    is_known = is_exact || !is_kinked;
    if (is_exact)
      normal = distances.normal(body, x);
    else if (!is_kinked)
      {
        normal = lattice.value_and_gradient(x, 3).second;
        normal /= normal.norm();
      }
  }

  dealii::Tensor<1, dim> normal; //!< out of the body
  bool                   is_known = false, is_exact = false, is_kinked = false;
};

/** Whether a body has the same normal a cell beside x. */
template <int dim>
bool
is_flat(const ExactDistances<dim> &distances, const unsigned int body, const dealii::Point<dim> &x,
        const dealii::Tensor<1, dim> &normal, const double size)
{
  constexpr double same = 1e-6;
  for (const auto &tangent : surface_tangents<dim>(normal))
    for (const double side : {-size, size})
      if ((distances.normal(body, x + side * tangent) - normal).norm() > same)
        return false;
  return true;
}
} // namespace

template <int dim>
ContactNormal<dim>
contact_normal(const ExactDistances<dim> &distances, const std::vector<Body<dim>> &bodies,
               const unsigned int a, const unsigned int b, const dealii::Point<dim> &x,
               const double size, const dealii::Tensor<1, dim> &of_cut)
{
  constexpr double   facing = 0.9; // cosine
  const Side<dim>    of_a(distances, bodies, a, x, size), of_b(distances, bodies, b, x, size);
  ContactNormal<dim> result{of_cut, NormalOf::both,
                            (of_a.is_exact && of_a.is_kinked) || (of_b.is_exact && of_b.is_kinked)};
  const auto         take = [&](const bool is_of_a) {
    const Side<dim> &side = is_of_a ? of_a : of_b;
    result.normal         = is_of_a ? side.normal : -side.normal;
    if (side.is_exact)
      result.of = is_of_a ? NormalOf::body_a : NormalOf::body_b;
  };
  const bool a_is_firm = of_a.is_exact && bodies[a].displacement.is_empty(),
             b_is_firm = of_b.is_exact && bodies[b].displacement.is_empty();
  if (a_is_firm != b_is_firm && !(a_is_firm ? of_a : of_b).is_kinked)
    {
      take(a_is_firm);
      result.is_flat
        = is_flat(distances, a_is_firm ? a : b, x, (a_is_firm ? of_a : of_b).normal, size);
    }
  else if (of_a.is_known && of_b.is_known)
    {
      const bool face_each_other = a_is_firm && b_is_firm && -(of_a.normal * of_b.normal) > facing;
      if (face_each_other || of_a.is_kinked == of_b.is_kinked)
        {
          result.normal        = of_a.normal - of_b.normal;
          result.is_undeformed = face_each_other;
        }
      else
        take(!of_a.is_kinked);
    }
  else if (of_a.is_known || of_b.is_known)
    take(of_a.is_known);
  const double length = result.normal.norm();
  if (length > 0.1)
    result.normal /= length;
  else
    result = {of_cut / of_cut.norm(), NormalOf::both, result.is_near_kink};
  return result;
}

#define SCREE_INSTANTIATE(dim)                                                             \
  template bool               is_smooth(const Lattice<dim> &, const dealii::Point<dim> &); \
  template ContactNormal<dim> contact_normal(                                              \
    const ExactDistances<dim> &, const std::vector<Body<dim>> &, const unsigned int,       \
    const unsigned int, const dealii::Point<dim> &, const double, const dealii::Tensor<1, dim> &);

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
