#pragma once

#include <boost/archive/binary_iarchive_impl.hpp>
#include <boost/archive/impl/archive_serializer_map.ipp>
#include <boost/archive/impl/basic_binary_iarchive.ipp>
#include <boost/archive/impl/basic_binary_iprimitive.ipp>
#include <boost/serialization/array_optimization.hpp>
#include <boost/serialization/collection_size_type.hpp>
#include <cstdint>
#include <istream>
#include <stdexcept>
#include <string>

namespace scree
{
/**
 * Reads what boost::archive::binary_oarchive wrote, from bytes that may be damaged: a length above
 * the number of all bytes is refused before anything asks for so much memory.
 */
class BoundedArchive
    : public boost::archive::binary_iarchive_impl<BoundedArchive, char, std::char_traits<char>>
{
  using Base = boost::archive::binary_iarchive_impl<BoundedArchive, char, std::char_traits<char>>;
  friend class boost::archive::detail::interface_iarchive<BoundedArchive>;
  friend class boost::archive::basic_binary_iarchive<BoundedArchive>;
  friend class boost::archive::load_access;
  friend class boost::archive::basic_binary_iprimitive<BoundedArchive, char,
                                                       std::char_traits<char>>;

public:
  /** @throws boost::archive::archive_exception if the bytes do not begin as an archive */
  BoundedArchive(std::istream &bytes, const std::uint64_t n_bytes)
      : Base(bytes, 0u)
      , n_bytes(n_bytes)
  {
    init(0u);
  }

protected:
  using Base::load;
  using Base::load_override;

  /** @throws std::length_error if it is longer than all bytes */
  void load_override(boost::serialization::collection_size_type &length)
  {
    Base::load_override(length);
    require_possible(length);
  }

  /** @throws std::length_error if it is longer than all bytes */
  void load(std::string &text)
  {
    std::size_t length = 0;
    Base::load(length);
    require_possible(length);
    text.resize(length);
    load_binary(text.data(), length);
  }

private:
  void require_possible(const std::uint64_t length) const
  {
    if (length > n_bytes)
      throw std::length_error("a length of " + std::to_string(length) + " in "
                              + std::to_string(n_bytes) + " bytes");
  }

  std::uint64_t n_bytes;
};
} // namespace scree

// As of binary_oarchive: numbers of an array are one block.
BOOST_SERIALIZATION_USE_ARRAY_OPTIMIZATION(scree::BoundedArchive)
