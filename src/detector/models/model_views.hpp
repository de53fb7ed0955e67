#pragma once

#include <vector>

#include "detector/models/search_model.hpp"

namespace credo {

/// What a model shows from each of `view_directions`; its points, mesh, centre and radius are
/// there.
[[nodiscard]] std::vector<ModelView> views_of(SearchModel const& model);

}  // namespace credo
