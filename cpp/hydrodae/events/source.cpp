#include "hydrodae/events/source.h"

namespace hydrodae::events {

std::optional<double> locate(std::span<Source* const> sources, double t0, double t1, int degree,
                             const Interpolant& at) {
  std::size_t count = 0;
  for (const Source* source : sources)
    count += source->count();
  VectorX y, yp;
  const Margins margins = [&](double t, std::span<double> out) {
    at(t, y, yp);
    for (Source* source : sources) {
      source->margins(t, y, yp, out.first(source->count()));
      out = out.subspan(source->count());
    }
  };
  std::optional<Root> root = first_root(margins, count, t0, t1, degree);
  if (!root)
    return std::nullopt;
  for (Source* source : sources) {
    if (root->which < source->count())
      return source->found(*root, at);
    root->which -= source->count();
  }
  return std::nullopt;
}

} // namespace hydrodae::events
