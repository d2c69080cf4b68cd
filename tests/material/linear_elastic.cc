// Stress is the derivative of the energy and the tangent that of the stress; values of plane
// strain; what a parameter file may say.
#include <gtest/gtest.h>

#include <scree/base/exceptions.h>
#include <scree/material/increment_law.h>
#include <scree/material/material.h>
#include <scree/parameters/file.h>

#include <cmath>
#include <limits>

namespace scree
{
namespace
{
using namespace dealii;

MaterialParameters
steel()
{
  MaterialParameters parameters;
  parameters.young   = 210e3;
  parameters.poisson = 0.3;
  parameters.density = 7.8;
  return parameters;
}

template <int dim>
SymmetricTensor<2, dim>
some_strain()
{
  SymmetricTensor<2, dim> strain;
  for (unsigned int i = 0; i < SymmetricTensor<2, dim>::n_independent_components; ++i)
    strain.access_raw_entry(i) = 1e-3 * (1 + i) * (i % 2 == 0 ? 1 : -0.7);
  return strain;
}

/** Energy and stress are polynomials of degree 2 and 1: central differences are exact. */
template <int dim>
void
check_derivatives()
{
  const auto   law    = make_material<dim>(steel());
  const auto   strain = some_strain<dim>();
  const double step   = 1e-3;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      {
        SymmetricTensor<2, dim> change; // both (i,j) and (j,i) of the full tensor
        change[i][j] = step;
        const double by_energy
          = (law->energy_density(strain + change) - law->energy_density(strain - change))
            / (2 * step);
        const double stress = law->stress(strain)[i][j];
        EXPECT_NEAR(by_energy, i == j ? stress : 2 * stress, 1e-8 * 210e3);

        const auto by_stress
          = (law->stress(strain + change) - law->stress(strain - change)) / (2 * step);
        EXPECT_NEAR((by_stress - law->tangent(strain) * change / step).norm(), 0, 1e-8 * 210e3);
      }
  EXPECT_EQ(law->energy_density(SymmetricTensor<2, dim>()), 0);
}

TEST(LinearElastic, StressAndTangentAreDerivatives)
{
  check_derivatives<2>();
  check_derivatives<3>();
}

TEST(LinearElastic, UniaxialStressInPlaneStrain)
{
  // sigma_yy = s alone in the plane: eps_yy = s (1-nu^2)/E, eps_xx = -s nu (1+nu)/E, sigma_zz = nu
  // s.
  const double          E = 210e3, nu = 0.3, s = 100;
  SymmetricTensor<2, 2> strain;
  strain[0][0]      = -s * nu * (1 + nu) / E;
  strain[1][1]      = s * (1 - nu * nu) / E;
  const auto law    = make_material<2>(steel());
  const auto stress = law->stress(strain);
  EXPECT_NEAR(stress[0][0], 0, 1e-10);
  EXPECT_NEAR(stress[1][1], s, 1e-10);
  EXPECT_NEAR(stress[0][1], 0, 1e-10);
  EXPECT_NEAR(law->out_of_plane_stress(strain), nu * s, 1e-10);
  EXPECT_NEAR(law->energy_density(strain), s * strain[1][1] / 2, 1e-12);
}

TEST(LinearElastic, UniaxialStressInThreeDimensions)
{
  const double          E = 210e3, nu = 0.3, s = 100;
  SymmetricTensor<2, 3> strain;
  strain[0][0]      = s / E;
  strain[1][1]      = -nu * s / E;
  strain[2][2]      = -nu * s / E;
  const auto stress = make_material<3>(steel())->stress(strain);
  EXPECT_NEAR(stress[0][0], s, 1e-10);
  EXPECT_NEAR(stress[1][1], 0, 1e-10);
  EXPECT_NEAR(stress[2][2], 0, 1e-10);
}

TEST(LinearElastic, Moduli)
{
  const auto law = make_material<2>(steel());
  EXPECT_NEAR(law->young(), 210e3, 1e-8);
  EXPECT_NEAR(law->poisson(), 0.3, 1e-15);
  EXPECT_NEAR(law->shear_modulus(), 210e3 / 2.6, 1e-9);
  EXPECT_NEAR(law->lame_lambda(), 210e3 * 0.3 / (1.3 * 0.4), 1e-9);
  // The stress of a confined bar.
  SymmetricTensor<2, 2> strain;
  strain[0][0] = 1;
  EXPECT_NEAR(law->p_wave_modulus(), law->stress(strain)[0][0], 1e-8);
  EXPECT_EQ(law->density(), 7.8);
  EXPECT_TRUE(law->is_linear());
}

TEST(MaterialParameters, AreReadByName)
{
  ParameterFile file      = ParameterFile::from_string("subsection Materials\n"
                                                            "  set Names = steel, rubber\n"
                                                            "  subsection steel\n"
                                                            "    set Young's modulus = 210e3\n"
                                                            "    set Poisson's ratio = 0.3\n"
                                                            "    set Density = 7.8\n"
                                                            "  end\n"
                                                            "  subsection rubber\n"
                                                            "    set Young's modulus = 5\n"
                                                            "    set Poisson's ratio = 0.49\n"
                                                            "  end\n"
                                                            "end\n");
  auto          materials = declare_materials(file.root());
  file.check();
  ASSERT_EQ(materials.size(), 2u);
  EXPECT_EQ(materials["steel"].law, "linear elastic");
  EXPECT_EQ(materials["steel"].young, 210e3);
  EXPECT_EQ(materials["steel"].density, 7.8);
  EXPECT_EQ(materials["rubber"].poisson, 0.49);
  EXPECT_EQ(materials["rubber"].density, 0);
}

/** The message of the errors in a section of one material called "a". */
std::string
message_for(const std::string &entries)
{
  ParameterFile file = ParameterFile::from_string(
    "subsection Materials\nset Names = a\nsubsection a\n" + entries + "\nend\nend\n");
  declare_materials(file.root());
  try
    {
      file.check();
    }
  catch (const UserError &error)
    {
      return error.what();
    }
  return "";
}

TEST(MaterialParameters, AreChecked)
{
  const std::string nu = "set Poisson's ratio = 0.3\n", E = "set Young's modulus = 1\n";
  EXPECT_EQ(message_for(nu + E), "");
  EXPECT_NE(message_for(nu).find("\"Young's modulus\": must be set"), std::string::npos)
    << message_for(nu);
  EXPECT_NE(message_for(nu + "set Young's modulus = -1").find("greater than 0"), std::string::npos);
  EXPECT_NE(message_for(E).find("Poisson's ratio"), std::string::npos);
  for (const char *value : {"-1", "0.5", "0.7", "-3"})
    EXPECT_NE(message_for(E + "set Poisson's ratio = " + value).find("less than 0.5"),
              std::string::npos)
      << message_for(E + "set Poisson's ratio = " + value);
  EXPECT_NE(message_for(E + nu + "set Density = -1").find("Density"), std::string::npos);
  EXPECT_NE(message_for(E + nu + "set Law = linear elastik").find("linear elastic"),
            std::string::npos);
}

TEST(MaterialParameters, EveryLawCanBeChosen)
{
  for (const std::string &name : material_laws())
    {
      const std::string elastic = "set Young's modulus = 1\nset Poisson's ratio = 0.3\n";
      const std::string plastic = "set Yield stress = 2\nset Hardening modulus = 3\n";
      const std::string law     = "set Law = " + name + "\n";
      const bool        yields  = name.find("J2") != std::string::npos;
      EXPECT_EQ(is_plastic(name), yields) << name;
      EXPECT_EQ(needs_moving_geometry(name), name != "linear elastic" && name != "rigid") << name;
      if (name == "rigid")
        {
          EXPECT_EQ(message_for(law), "");
          EXPECT_NE(message_for(law + "set Yield stress = 1").find("\"Yield stress\" = 1: a rigid"),
                    std::string::npos);
          continue;
        }
      EXPECT_EQ(message_for(law + elastic + (yields ? plastic : "")), "") << name;
      const std::string wrong = message_for(law + elastic + (yields ? "" : plastic));
      const std::string reason
        = yields ? "\"Yield stress\": must be set" : "\"Yield stress\" = 2: the law '" + name + "'";
      EXPECT_NE(wrong.find(reason), std::string::npos) << wrong;
      EXPECT_NE(wrong.find("\"Hardening modulus\""), std::string::npos) << wrong;
    }
  const std::string J2 = "set Law = J2\nset Young's modulus = 1\nset Poisson's ratio = 0.3\n";
  EXPECT_NE(
    message_for(J2 + "set Yield stress = 0\nset Hardening modulus = 0").find("greater than 0"),
    std::string::npos);
  EXPECT_NE(
    message_for(J2 + "set Yield stress = 1\nset Hardening modulus = -1").find("not negative"),
    std::string::npos);
}

TEST(MaterialParameters, EveryDeformableLawHasItsModuliAtZeroStrain)
{
  MaterialParameters parameters = steel();
  for (const std::string &name : material_laws())
    {
      parameters.law = name;
      if (is_plastic(name))
        {
          parameters.yield_stress      = 100;
          parameters.hardening_modulus = 10;
        }
      else
        parameters.yield_stress = parameters.hardening_modulus
          = std::numeric_limits<double>::quiet_NaN();
      if (parameters.is_rigid())
        continue;
      const auto law = make_material<3>(parameters);
      EXPECT_NEAR(law->young(), 210e3, 1e-8) << name;
      // The tangent of the law in increments at the start is the same.
      const auto           increments = make_increment_law<3>(parameters);
      const Tensor<2, 3>   one(unit_symmetric_tensor<3>());
      const IncrementStart start = increments->start(PointHistory<3>());
      IncrementResponse<3> response;
      Tensor<4, 3>         tangent;
      increments->respond(
        ArrayView<const Tensor<2, 3>>(&one, 1), ArrayView<const IncrementStart>(&start, 1),
        ArrayView<IncrementResponse<3>>(&response, 1), ArrayView<Tensor<4, 3>>(&tangent, 1));
      const Tensor<4, 3> expected(law->tangent(SymmetricTensor<2, 3>()));
      EXPECT_LT((tangent - expected).norm(), 1e-10 * 210e3) << name;
    }
}

TEST(MaterialParameters, ConstantsThatLeaveNoDigitsAreRefused)
{
  const std::string elastic = "set Poisson's ratio = 0.3\nset Young's modulus = ";
  EXPECT_NE(message_for(elastic + "1e-300").find("between 1e-30 and 1e30"), std::string::npos);
  EXPECT_NE(message_for(elastic + "1e300").find("between 1e-30 and 1e30"), std::string::npos);
  const std::string unit = "set Young's modulus = 1\nset Poisson's ratio = ";
  EXPECT_NE(message_for(unit + "0.4999999999999999").find("nearer to 0.5"), std::string::npos);
  EXPECT_NE(message_for(unit + "-0.9999999999").find("nearer to -1"), std::string::npos);
  for (const std::string value : {"0.49999", "0.4999", "-0.999", "0"})
    EXPECT_EQ(message_for(unit + value), "");
}

TEST(MaterialParameters, MakeMaterialRefusesUnsetConstants)
{
  EXPECT_THROW(make_material<2>(MaterialParameters()), UserError);
  MaterialParameters incompressible = steel();
  incompressible.poisson            = 0.5;
  EXPECT_THROW(make_material<3>(incompressible), UserError);
  MaterialParameters unknown = steel();
  unknown.law                = "jelly";
  EXPECT_THROW(make_material<3>(unknown), UserError);
}
} // namespace
} // namespace scree
