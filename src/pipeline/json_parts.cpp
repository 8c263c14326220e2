// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/json_parts.h"

namespace geomend {

Json losses_json(std::span<const Loss> losses) {
    Json all = Json::array();
    for (const Loss& loss : losses) {
        all.push_back(Json{
            {"class", to_string(loss.loss_class)}, {"entity", loss.entity}, {"what", loss.what}, {"why", loss.why}, {"count", loss.count}});
    }
    return all;
}

}  // namespace geomend
