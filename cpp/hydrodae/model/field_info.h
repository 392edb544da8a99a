#pragma once
/// Description of the fields of a struct as data.

#include "hydrodae/model/tables.h"

namespace hydrodae::model {

/// Description of a field; `defaults` is a new struct of its table.
FieldInfo field_info(const AnyField& field, void* defaults);

template <class T> std::vector<FieldInfo> field_infos() {
  std::vector<FieldInfo> infos;
  T defaults{};
  for (const AnyField& field : T::fields())
    infos.push_back(field_info(field, &defaults));
  return infos;
}

} // namespace hydrodae::model
