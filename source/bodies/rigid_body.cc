#include <scree/base/exceptions.h>
#include <scree/bodies/motion_keys.h>
#include <scree/bodies/rigid_body.h>
#include <scree/parameters/expression_entry.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace scree
{
namespace
{
using Tensor1 = dealii::Tensor<1, 3>;
using Tensor2 = dealii::Tensor<2, 3>;

/** Stumpff's functions c_0 ... c_3 of s >= 0. */
std::array<double, 4>
stumpff(const double s)
{
  if (s > 1.)
    {
      const double theta = std::sqrt(s);
      const double c0 = std::cos(theta), c1 = std::sin(theta) / theta;
      return {{c0, c1, (1. - c0) / s, (1. - c1) / s}};
    }
  std::array<double, 4> c{};
  double                factorial = 1.;
  for (unsigned int k = 0; k < 4; factorial *= ++k)
    {
      double term = 1. / factorial;
      for (unsigned int j = 1; j < 12; ++j)
        {
          c[k] += term;
          term *= -s / ((2. * j + k) * (2. * j + k - 1.));
        }
    }
  return c;
}

/** dc_k/ds for k = 0 ... 3, as the series sum_j -(j + 1) (-s)^j/(2j + 2 + k)! where s is small. */
std::array<double, 4>
stumpff_derivative(const double s, const std::array<double, 4> &c)
{
  if (s > 1.)
    return {{-0.5 * c[1], (c[0] - c[1]) / (2. * s), (c[1] - 2. * c[2]) / (2. * s),
             (c[2] - 3. * c[3]) / (2. * s)}};
  std::array<double, 4> dc{};
  double                factorial = 2.;
  for (unsigned int k = 0; k < 4; ++k, factorial *= 2. + k)
    {
      double term = -1. / factorial;
      for (unsigned int j = 1; j < 12; ++j)
        {
          dc[k] += j * term;
          term *= -s / ((2. * j + 2. + k) * (2. * j + 1. + k));
        }
    }
  return dc;
}

/** d2c_k/ds2 for k = 0, 1, 2. */
std::array<double, 3>
stumpff_second_derivative(const double s, const std::array<double, 4> &dc)
{
  if (s > 1.)
    return {{-0.5 * dc[1], (dc[0] - 3. * dc[1]) / (2. * s), (dc[1] - 4. * dc[2]) / (2. * s)}};
  std::array<double, 3> ddc{};
  double                factorial = 24.;
  for (unsigned int k = 0; k < 3; ++k, factorial *= 4. + k)
    {
      double term = 1. / factorial;
      for (unsigned int j = 1; j < 12; ++j)
        {
          ddc[k] += j * (j + 1.) * term;
          term *= -s / ((2. * j + 4. + k) * (2. * j + 3. + k));
        }
    }
  return ddc;
}

/** [w] with [w] r = w x r. */
Tensor2
cross_matrix(const Tensor1 &w)
{
  Tensor2 result;
  for (unsigned int i = 0; i < 3; ++i)
    {
      result[(i + 2) % 3][(i + 1) % 3] = w[i];
      result[(i + 1) % 3][(i + 2) % 3] = -w[i];
    }
  return result;
}

Tensor1
unit(const unsigned int i)
{
  Tensor1 e;
  e[i] = 1.;
  return e;
}

/** w_k = epsilon_kab S_ab: sum r x f of S = sum r f^T. */
Tensor1
axial(const Tensor2 &S)
{
  Tensor1 w;
  for (unsigned int k = 0; k < 3; ++k)
    w[k] = S[(k + 1) % 3][(k + 2) % 3] - S[(k + 2) % 3][(k + 1) % 3];
  return w;
}

template <int dim>
Tensor2
in_3d(const dealii::Tensor<2, dim> &tensor)
{
  Tensor2 result;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      result[i][j] = tensor[i][j];
  return result;
}

template <int dim>
dealii::Tensor<1, dim>
product(const Tensor2 &matrix, const dealii::Tensor<1, dim> &vector)
{
  dealii::Tensor<1, dim> result;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      result[i] += matrix[i][j] * vector[j];
  return result;
}
} // namespace

template <int dim>
std::vector<std::string>
rigid_component_names()
{
  if (dim == 2)
    return {"x", "y", "rotation"};
  return {"x", "y", "z", "rotation x", "rotation y", "rotation z"};
}

template <int dim>
void
MotionParameters<dim>::declare(ParameterSection &section)
{
  path = section.path();
  section.entry("Reference point", reference_point,
                "Where the translation is measured and forces act; the body rotates about it, "
                "moments refer to it. Default: the centre of the body's box [L].");
  is_given = section.is_set("Reference point");
  if (!reference_point.empty() && reference_point.size() != dim)
    section.error("Reference point", "needs " + std::to_string(dim) + " coordinates");
  for (unsigned int m = 0; m < n_rigid_components<dim>; ++m)
    {
      const bool        is_rotation = m >= dim;
      const std::string moved = motion_key<dim>(m, false), loaded = motion_key<dim>(m, true);
      section.formula(moved, motion[m],
                      is_rotation
                        ? (dim == 2 ? "Prescribed rotation, counter-clockwise, a formula "
                                      "of t [rad]."
                                    : "Prescribed component of the rotation vector, a "
                                      "formula of t [rad].")
                        : "Prescribed displacement of the reference point, a formula of t "
                          "[L].");
      section.formula(loaded, load[m],
                      is_rotation ? "Moment about the reference point in its current position, a "
                                    "formula of t; the rotation is then unknown [force L]."
                                  : "Force, a formula of t; the displacement is then unknown "
                                    "[force].");
      is_given |= !motion[m].empty() || !load[m].empty();
      if (!motion[m].empty() && !load[m].empty())
        section.error(loaded, "both " + moved + " and " + loaded + " are given",
                      "give the motion or the load of a component, not both");
      for (const auto &[key, text] :
           {std::make_pair(moved, motion[m]), std::make_pair(loaded, load[m])})
        if (!text.empty())
          check_expression<dim>(section, key, text, 1);
    }
}

template <int dim>
RigidBody<dim>::RigidBody(const MotionParameters<dim>    &parameters,
                          const dealii::BoundingBox<dim> &box, const Lattice<dim> &picture,
                          const std::shared_ptr<const Shape<dim>> &shape, const double density)
    : reference_point(box.center())
    , radius(0.)
    , box(box)
    , picture(picture)
    , shape(shape)
    , density(density)
    , path(parameters.path)
{
  if (density > 0.)
    moments = moments_of(*shape, picture);
  if (!parameters.reference_point.empty())
    for (unsigned int d = 0; d < dim; ++d)
      reference_point[d] = parameters.reference_point[d];
  for (unsigned int d = 0; d < dim; ++d)
    radius = std::max(radius, 0.5 * box.side_length(d));
  set_motion(parameters);
}

template <int dim>
bool
RigidBody<dim>::set_motion(const MotionParameters<dim> &parameters)
{
  const auto before = free;
  values.clear();
  for (unsigned int m = 0; m < n_rigid_components<dim>; ++m)
    {
      free[m]                 = !parameters.load[m].empty();
      const std::string &text = free[m] ? parameters.load[m] : parameters.motion[m];
      values.emplace_back(text.empty() ? "0" : text, 1, path);
    }
  return free != before;
}

template <int dim>
bool
RigidBody<dim>::is_free() const
{
  return std::find(free.begin(), free.end(), true) != free.end();
}

template <int dim>
double
RigidBody<dim>::value(const unsigned int component, const double time) const
{
  const double result = values[component].value(reference_point, time);
  if (!std::isfinite(result))
    {
      std::ostringstream what;
      what << "'" << values[component].text() << "' is no finite number at t = " << time;
      throw UserError(path, what.str(), "check divisions, roots and logarithms");
    }
  return result;
}

template <int dim>
typename RigidPose<dim>::Unknowns
RigidPose<dim>::unwound(const RigidBody<dim> &body, const Unknowns &q)
{
  Unknowns result = q;
  double   square = 0.;
  bool     turns  = dim == 3;
  for (unsigned int m = dim; m < q.size(); ++m)
    {
      square += q[m] * q[m];
      turns &= body.is_free(m);
    }
  const double angle = std::sqrt(square) / body.radius;
  if (turns && angle > dealii::numbers::PI)
    for (unsigned int m = dim; m < q.size(); ++m)
      result[m] *= 1. - 2. * dealii::numbers::PI / angle;
  return result;
}

template <int dim>
RigidPose<dim>::RigidPose()
    : q()
    , radius(1.)
    , c()
    , dc()
    , ddc()
    , R(dealii::unit_symmetric_tensor<3>())
{
}

template <int dim>
RigidPose<dim>::RigidPose(const RigidBody<dim> &body, const Unknowns &q)
    : q(q)
    , centre(body.reference_point)
    , radius(body.radius)
{
  for (unsigned int m = 0; m < n_rigid_components<dim>; ++m)
    if (m < dim)
      shift[m] = q[m];
    else
      theta[rotation_axis<dim>(m)] = q[m] / radius;
  const double s = theta * theta;
  c              = stumpff(s);
  dc             = stumpff_derivative(s, c);
  ddc            = stumpff_second_derivative(s, dc);

  const Tensor2 identity = dealii::unit_symmetric_tensor<3>();
  const Tensor2 cross = cross_matrix(theta), square = outer_product(theta, theta);
  R = c[0] * identity + c[1] * cross + c[2] * square;
  for (unsigned int i = 0; i < 3; ++i)
    dR[i] = 2. * theta[i] * (dc[0] * identity + dc[1] * cross + dc[2] * square)
            + c[1] * cross_matrix(unit(i))
            + c[2] * (outer_product(unit(i), theta) + outer_product(theta, unit(i)));
}

template <int dim>
dealii::Tensor<1, dim>
RigidPose<dim>::displacement(const dealii::Point<dim> &X) const
{
  const dealii::Tensor<1, dim> arm = X - centre;
  return product(R, arm) - arm + shift;
}

template <int dim>
dealii::Point<dim>
RigidPose<dim>::initial_position(const dealii::Point<dim> &x) const
{
  const dealii::Tensor<1, dim> arm = x - centre - shift;
  return x - shift + (product(transpose(R), arm) - arm);
}

template <int dim>
dealii::Tensor<2, dim>
RigidPose<dim>::initial_gradient() const
{
  dealii::Tensor<2, dim> result;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      result[i][j] = R[j][i];
  return result;
}

template <int dim>
std::array<dealii::Tensor<1, dim>, n_rigid_components<dim>>
RigidPose<dim>::derivative(const dealii::Point<dim> &X) const
{
  const dealii::Tensor<1, dim>                                arm = X - centre;
  std::array<dealii::Tensor<1, dim>, n_rigid_components<dim>> result;
  for (unsigned int m = 0; m < n_rigid_components<dim>; ++m)
    if (m < dim)
      result[m][m] = 1.;
    else
      result[m] = product(dR[rotation_axis<dim>(m)], arm) / radius;
  return result;
}

template <int dim>
typename RigidPose<dim>::Unknowns
RigidPose<dim>::generalised_force(const Load &load) const
{
  const Tensor2 S = in_3d(load.couple);
  Unknowns      result;
  for (unsigned int m = 0; m < n_rigid_components<dim>; ++m)
    result[m]
      = m < dim ? load.force[m] : scalar_product(transpose(dR[rotation_axis<dim>(m)]), S) / radius;
  return result;
}

template <int dim>
Tensor2
RigidPose<dim>::curvature(const Load &load) const
{
  // h(theta) = f.R r with f.r = tr S, theta.(r x f) = theta.w, (f.theta)(theta.r) = theta.S theta
  const Tensor2 S = in_3d(load.couple), symmetric = S + transpose(S);
  const Tensor1 w = axial(S), m = symmetric * theta;
  const double  trace_S = trace(S), theta_w = theta * w, theta_S = 0.5 * (theta * m);
  const double  first  = dc[0] * trace_S + dc[1] * theta_w + dc[2] * theta_S;
  const double  second = ddc[0] * trace_S + ddc[1] * theta_w + ddc[2] * theta_S;
  const Tensor1 mixed  = 2. * (dc[1] * w + dc[2] * m);
  Tensor2       result = 2. * first * dealii::unit_symmetric_tensor<3>();
  result += 4. * second * outer_product(theta, theta);
  result += outer_product(theta, mixed) + outer_product(mixed, theta) + c[2] * symmetric;
  return result / (radius * radius);
}

template <int dim>
Tensor1
RigidPose<dim>::moment(const Load &load) const
{
  return axial(R * in_3d(load.couple));
}

template <int dim>
Tensor1
RigidPose<dim>::generalised_moment(const Tensor1 &moment) const
{
  // J = c_1 I + c_2 [theta] + c_3 theta theta^T, dR = [J dtheta] R
  return (c[1] * moment - c[2] * cross_product_3d(theta, moment) + c[3] * (theta * moment) * theta)
         / radius;
}

template <int dim>
Tensor2
RigidPose<dim>::generalised_moment_derivative(const Tensor1 &moment) const
{
  const Tensor1 cross = cross_product_3d(theta, moment);
  const double  along = theta * moment;
  Tensor2       result
    = 2. * outer_product(dc[1] * moment - dc[2] * cross + dc[3] * along * theta, theta);
  result += c[3] * (along * dealii::unit_symmetric_tensor<3>() + outer_product(theta, moment));
  result += c[2] * cross_matrix(moment); // -e_j x M = M x e_j
  return result / (radius * radius);
}

#define SCREE_INSTANTIATE(dim)                                    \
  template std::vector<std::string> rigid_component_names<dim>(); \
  template struct MotionParameters<dim>;                          \
  template class RigidBody<dim>;                                  \
  template class RigidPose<dim>;

SCREE_INSTANTIATE(2)
SCREE_INSTANTIATE(3)
} // namespace scree
