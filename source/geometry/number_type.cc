#include <scree/geometry/number_type.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace scree
{
std::size_t
size_of(const NumberType type)
{
  switch (type)
    {
    case NumberType::uint8:
    case NumberType::int8:
      return 1;
    case NumberType::uint16:
    case NumberType::int16:
      return 2;
    case NumberType::uint32:
    case NumberType::int32:
    case NumberType::float32:
      return 4;
    default:
      return 8;
    }
}

namespace
{
template <typename T>
double
number_of_bytes(const char *first, const bool swaps)
{
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), first, sizeof(T));
  if (swaps)
    std::reverse(bytes.begin(), bytes.end());
  T number;
  std::memcpy(&number, bytes.data(), sizeof(T));
  return static_cast<double>(number);
}
} // namespace

double
number_at(const char *bytes, const NumberType type, const bool swaps)
{
  switch (type)
    {
    case NumberType::uint8:
      return number_of_bytes<std::uint8_t>(bytes, swaps);
    case NumberType::int8:
      return number_of_bytes<std::int8_t>(bytes, swaps);
    case NumberType::uint16:
      return number_of_bytes<std::uint16_t>(bytes, swaps);
    case NumberType::int16:
      return number_of_bytes<std::int16_t>(bytes, swaps);
    case NumberType::uint32:
      return number_of_bytes<std::uint32_t>(bytes, swaps);
    case NumberType::int32:
      return number_of_bytes<std::int32_t>(bytes, swaps);
    case NumberType::uint64:
      return number_of_bytes<std::uint64_t>(bytes, swaps);
    case NumberType::int64:
      return number_of_bytes<std::int64_t>(bytes, swaps);
    case NumberType::float32:
      return number_of_bytes<float>(bytes, swaps);
    default:
      return number_of_bytes<double>(bytes, swaps);
    }
}

bool
machine_is_little_endian()
{
  const std::uint16_t one = 1;
  char                first;
  std::memcpy(&first, &one, 1);
  return first == 1;
}
} // namespace scree
