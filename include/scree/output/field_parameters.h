#pragma once

#include <scree/parameters/section.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace scree
{
/** What a field measures, for the name of its unit. */
enum class Quantity
{
  number, // without unit
  length,
  area, // the measure of a surface: a length in 2D
  volume,
  velocity,
  stress
};

/** Which fields the files of bodies have, and how their units are called. */
struct FieldParameters
{
  /** Besides displacement, velocity and body. */
  std::vector<std::string> chosen = {"stress", "plastic strain"};
  /** Names of the units of length, stress and force; empty: not known. */
  std::vector<std::string> units;

  /** Reads the entry Fields. */
  void declare(ParameterSection &section);

  bool has(const std::string &field) const;

  /** The name of the unit of a quantity; empty if it has none or the input names none. */
  std::string unit(const Quantity quantity, const unsigned int dim) const;
};

/** The units of the fields that have one, by name; the name of columns NAME_x ... is NAME too. */
std::map<std::string, std::string>
unit_labels(const FieldParameters                               &parameters,
            const std::vector<std::pair<std::string, Quantity>> &fields, const unsigned int dim);
} // namespace scree
