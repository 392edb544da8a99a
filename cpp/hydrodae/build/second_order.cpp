#include "hydrodae/build/parts.h"
namespace hydrodae::build {
void add_second_order(const model::Scene&, const Sea&, system::System&) {}
} // namespace hydrodae::build
