#pragma once

#include <scree/geometry/label_readers.h>

namespace scree
{
/** The fields of a header of NRRD or MetaImage. */
struct VolumeHeader
{
  struct Field
  {
    std::string key; //!< in small letters, of NRRD without blanks
    std::string value;
    std::size_t begin, end; //!< of its line in the file
  };

  std::string        name; //!< of the file, for messages
  std::vector<Field> fields;
  std::size_t        data_begin; //!< the first byte behind the header

  /** nullptr if there is none. */
  const Field *find(const std::string &key) const;

  /** @throws UserError if there is no such field */
  const std::string &value(const std::string &key) const;
};

/** Whether the bytes begin as a header of NRRD or MetaImage does. */
bool has_volume_header(const std::string &bytes);

/** @throws UserError if what the bytes begin with is damaged */
VolumeHeader volume_header(const std::string &bytes, const std::string &name);
} // namespace scree
