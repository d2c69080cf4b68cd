#pragma once

#include <cstddef>

namespace scree
{
/** How a file holds numbers. */
enum class NumberType
{
  uint8,
  int8,
  uint16,
  int16,
  uint32,
  int32,
  uint64,
  int64,
  float32,
  float64
};

/** Bytes of a number. */
std::size_t size_of(const NumberType type);

/** The number that begins at `bytes`. @param swaps whether its bytes stand in the other order */
double number_at(const char *bytes, const NumberType type, const bool swaps);

/** Whether this machine has the lowest byte of a number first. */
bool machine_is_little_endian();
} // namespace scree
