#include "hydrodae/system/system.h"

namespace hydrodae::system {

System::System() = default;
System::~System() = default;
System::System(const System&) = default;
System::System(System&&) noexcept = default;
System& System::operator=(const System&) = default;
System& System::operator=(System&&) noexcept = default;

} // namespace hydrodae::system
