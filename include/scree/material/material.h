#pragma once

#include <scree/parameters/section.h>

#include <deal.II/base/symmetric_tensor.h>

#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace scree
{
/** What a parameter file says about one material. */
struct MaterialParameters
{
  /** Name of the law, one of material_laws(). */
  std::string law = "linear elastic";

  /** Young's modulus E > 0 [force/length^2]; NaN: not set, which is an error of the input. */
  double young = std::numeric_limits<double>::quiet_NaN();

  /** Poisson's ratio, -1 < nu < 1/2; NaN: not set, which is an error of the input. */
  double poisson = std::numeric_limits<double>::quiet_NaN();

  /** Mass per volume in the reference configuration, >= 0 [mass/length^3]. */
  double density = 0;

  /**
   * Yield stress sigma_y > 0 and hardening modulus H >= 0 [force/length^2]; NaN: not set, as it
   * must be for laws that are not plastic.
   */
  double yield_stress      = std::numeric_limits<double>::quiet_NaN();
  double hardening_modulus = std::numeric_limits<double>::quiet_NaN();

  /** Whether bodies of this material do not deform. */
  bool is_rigid() const;

  /** Reads the entries of one material and records what is not allowed. */
  void declare(const ParameterSection &section);
};

/**
 * Reads the section `Materials` of `root`: `set Names = steel, rubber` and one subsection per name.
 */
std::map<std::string, MaterialParameters> declare_materials(const ParameterSection &root);

/** @throws UserError unless all constants are set and allowed that the law has, and no others. */
void check_constants(const MaterialParameters &parameters);

/** The names a material law may have: the laws in increments and rigid. */
std::vector<std::string> material_laws();

/**
 * Whether the law of that name is one for bodies that move with their material points: all but
 * "linear elastic", which is the same on a fixed geometry and on one that moves, and "rigid".
 */
bool needs_moving_geometry(const std::string &law);

/**
 * A constitutive law at small strain `eps = sym grad u`; stress is positive in tension. In two
 * dimensions the state is plane strain, eps_zz = 0. Stress, energy density and moduli have the unit
 * of Young's modulus.
 *
 * Loops over many points ask is_linear() once and then use tangent() or the moduli as constants,
 * so that no virtual function is called per point.
 */
template <int dim>
class Material
{
public:
  /** @param density mass per volume */
  explicit Material(const double density);

  virtual ~Material() = default;

  /** Stress `sigma(eps) = d psi / d eps`. */
  virtual dealii::SymmetricTensor<2, dim>
  stress(const dealii::SymmetricTensor<2, dim> &strain) const = 0;

  /** Tangent `C(eps) = d sigma / d eps`. */
  virtual dealii::SymmetricTensor<4, dim>
  tangent(const dealii::SymmetricTensor<2, dim> &strain) const = 0;

  /** Energy per volume `psi(eps)`, zero without strain. */
  virtual double energy_density(const dealii::SymmetricTensor<2, dim> &strain) const = 0;

  /** `sigma_zz(eps)` of plane strain. It exists for dim == 2 only (asserted). */
  virtual double out_of_plane_stress(const dealii::SymmetricTensor<2, dim> &strain) const = 0;

  /** Whether the tangent is the same for all strains. */
  virtual bool is_linear() const = 0;

  /** Lame's first constant `lambda` at zero strain. */
  virtual double lame_lambda() const = 0;

  /** Shear modulus `mu` at zero strain. */
  virtual double shear_modulus() const = 0;

  /** Young's modulus `E = mu (3 lambda + 2 mu)/(lambda + mu)` at zero strain. */
  double young() const;

  /** Poisson's ratio `nu = lambda/(2 (lambda + mu))` at zero strain. */
  double poisson() const;

  /** P-wave modulus `2 mu + lambda` at zero strain; `sqrt((2 mu + lambda)/rho)` is a wave speed. */
  double p_wave_modulus() const;

  /** Mass per volume in the reference configuration. */
  double density() const;

private:
  double mass_density;
};

/**
 * The law at small strain of the material: LinearElastic with the moduli at zero strain, whatever
 * deformable law `parameters` names (the whole law is that of make_increment_law()); none (null)
 * for a rigid material. Penalties, supports and estimates take their moduli from it.
 *
 * @throws UserError if there is no law of that name or a constant is not allowed
 */
template <int dim>
std::unique_ptr<Material<dim>> make_material(const MaterialParameters &parameters);
} // namespace scree
