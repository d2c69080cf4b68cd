#include <scree/bodies/rigid_placement.h>
#include <scree/geometry/level_set_from_shape.h>
#include <scree/level_set/reboxing.h>

#include <deal.II/base/geometry_info.h>

#include <algorithm>
#include <memory>
#include <optional>

namespace scree
{
namespace
{
/** A shape at a pose of its body. */
template <int dim>
class PlacedShape : public Shape<dim>
{
public:
  PlacedShape(const std::shared_ptr<const Shape<dim>> &shape, const RigidPose<dim> &pose)
      : shape(shape)
      , pose(pose)
  {
  }

  double signed_distance(const dealii::Point<dim> &x) const override
  {
    return shape->signed_distance(pose.initial_position(x));
  }

  bool is_distance() const override
  {
    return shape->is_distance();
  }

  bool has_curvature_jumps() const override
  {
    return shape->has_curvature_jumps();
  }

  /** Around the moved corners of the shape's box. */
  dealii::BoundingBox<dim> bounding_box() const override
  {
    const dealii::BoundingBox<dim>  box = shape->bounding_box();
    std::vector<dealii::Point<dim>> corners;
    for (unsigned int i = 0; i < dealii::GeometryInfo<dim>::vertices_per_cell; ++i)
      corners.push_back(box.vertex(i) + pose.displacement(box.vertex(i)));
    return dealii::BoundingBox<dim>(corners);
  }

private:
  std::shared_ptr<const Shape<dim>> shape;
  RigidPose<dim>                    pose;
};

/** The part of `box` inside `limits`, or the nearest place in them. */
template <int dim>
dealii::BoundingBox<dim>
clamped(const dealii::BoundingBox<dim> &box, const dealii::BoundingBox<dim> &limits)
{
  dealii::Point<dim> lower, upper;
  for (unsigned int d = 0; d < dim; ++d)
    {
      lower[d] = std::clamp(box.lower_bound(d), limits.lower_bound(d), limits.upper_bound(d));
      upper[d] = std::clamp(box.upper_bound(d), limits.lower_bound(d), limits.upper_bound(d));
    }
  return dealii::BoundingBox<dim>({lower, upper});
}

/** A few nodes at the place nearest to a body that has left: evaluations add the distance. */
template <int dim>
Lattice<dim>
lattice_of_absent(const Shape<dim> &shape, const LatticeFrame<dim> &frame,
                  const dealii::Point<dim> &place, const double least)
{
  dealii::Point<dim> upper = place;
  for (unsigned int d = 0; d < dim; ++d)
    upper[d] += 4. * frame.spacing;
  const NodeBox<dim> box = node_box(frame, place, upper);
  Lattice<dim>       lattice(frame, box.lower, box.n_nodes);
  for (std::size_t i = 0; i < lattice.values().size(); ++i)
    lattice.values()[i] = std::max(shape.signed_distance(lattice.node(lattice.index(i))), least);
  return lattice;
}
} // namespace

template <int dim>
void
place_rigid_body(Body<dim> &body, const typename RigidPose<dim>::Unknowns &q,
                 const LatticeFrame<dim> &frame, const double margin)
{
  Assert(body.is_rigid(), dealii::ExcMessage("The body is not rigid."));
  if (q == body.pose.unknowns())
    return;
  LatticeFrame<dim> wide_frame = frame;
  wide_frame.box.extend(margin);
  const RigidPose<dim> pose(*body.rigid, q);
  const auto           shape = std::make_shared<const PlacedShape<dim>>(body.rigid->shape, pose);
  auto                 lattice
    = find_lattice<dim>(shape, wide_frame, margin, body.path + "/Shape", largest_cheap_lattice);
  body.box = clamped(shape->bounding_box(), wide_frame.box);
  body.level_set
    = lattice.has_value()
        ? *std::move(lattice)
        : lattice_of_absent<dim>(*shape, wide_frame, body.box.get_boundary_points().first, margin);
  body.pose = pose;
}

template void place_rigid_body(Body<2> &, const RigidPose<2>::Unknowns &, const LatticeFrame<2> &,
                               const double);
template void place_rigid_body(Body<3> &, const RigidPose<3>::Unknowns &, const LatticeFrame<3> &,
                               const double);
} // namespace scree
