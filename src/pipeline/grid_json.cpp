// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/json_parts.h"
#include "pipeline/make_grid.h"

namespace geomend {

namespace {

Json zones_json(const GridMade& made) {
    Json zones = Json::array();
    for (std::size_t z = 0; z < made.made.zones.size(); ++z) {
        const auto& r = made.made.zones[z];
        Json zone{{"name", r.name},     {"number", z + 1},    {"first_layer", r.first_layer + 1},        {"last_layer", r.last_layer + 1},
                  {"volume", r.volume}, {"active", r.active}, {"without_thickness", r.without_thickness}};
        if (z < made.map_volumes.size()) {
            zone["map_volume"] = made.map_volumes[z].maps;
            zone["volume_where_maps"] = made.map_volumes[z].grid;
        }
        zones.push_back(std::move(zone));
    }
    return zones;
}

Json faults_json(const gridding::GridReport& made) {
    Json faults = Json::array();
    for (const auto& r : made.faults) {
        if (!r.why_not.empty()) continue;
        faults.push_back({{"name", r.name},
                          {"faces", r.faces},
                          {"boxes", r.boxes},
                          {"max_deviation", r.max_deviation},
                          {"mean_deviation", r.mean_deviation},
                          {"max_deviation_cells", r.max_deviation_cells},
                          {"mean_deviation_cells", r.mean_deviation_cells},
                          {"max_throw", r.max_throw},
                          {"max_lean", r.max_lean},
                          {"shared_faces", r.shared},
                          {"ends_on", r.ends_on}});
    }
    return faults;
}

Json horizons_json(const gridding::GridReport& made) {
    Json horizons = Json::array();
    for (const auto& r : made.horizons) {
        horizons.push_back({{"name", r.name},
                            {"read", r.read},
                            {"extended", r.extended},
                            {"without_value", r.filled},
                            {"unfaulted_pillars", r.unfaulted},
                            {"max_difference", r.max_difference},
                            {"gave_way", r.moved},
                            {"max_gave_way", r.max_moved}});
    }
    return horizons;
}

Json reason_json(const std::string& name, const std::string& why) { return {{"name", name}, {"why", why}}; }

Json left_out_json(const GridMade& made) {
    Json out = Json::array();
    for (const auto& r : made.made.faults) {
        if (!r.why_not.empty()) out.push_back(reason_json(r.name, r.why_not));
    }
    for (const auto& l : made.left_out) out.push_back(reason_json(l.name, l.why));
    return out;
}

Json upright_json(const gridding::GridReport& made) {
    Json upright = Json::array();
    for (const auto& r : made.faults) {
        if (!r.why_upright.empty()) upright.push_back(reason_json(r.name, r.why_upright));
    }
    return upright;
}

Json properties_json(const GridMade& made) {
    Json properties = Json::array();
    for (const auto& p : made.properties)
        properties.push_back({{"name", p.name}, {"method", to_string(p.how)}, {"with_value", p.with}, {"without_value", p.without}});
    return properties;
}

}  // namespace

std::string grid_json(const GridMade& made) {
    Json all{{"dims", made.dims},
             {"active_cells", made.made.active},
             {"rotation", made.rotation},
             {"spacing", made.made.cell},
             {"blocks", made.made.blocks},
             {"joined_cells", made.made.joined_cells},
             {"zones", zones_json(made)},
             {"horizons", horizons_json(made.made)},
             {"faults", faults_json(made.made)},
             {"upright_pillars", upright_json(made.made)},
             {"right_angledness",
              {{"mean", made.made.mean_angles_after},
               {"least", made.made.least_angles_after},
               {"mean_before", made.made.mean_angles_before},
               {"least_before", made.made.least_angles_before},
               {"border_relaxed", made.made.border_relaxed}}},
             {"properties", properties_json(made)},
             {"left_out", left_out_json(made)},
             {"notes", made.notes},
             {"loss", losses_json(made.written.losses)}};
    if (!made.regions.empty()) all["regions"] = made.regions;
    if (made.nnc) all["nnc"] = *made.nnc;
    if (!made.beside.empty()) all["include"] = made.beside;
    if (!made.deck.empty()) all["deck"] = made.deck;
    return json_text(all);
}

}  // namespace geomend
