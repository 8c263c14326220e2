// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/contact_table.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/nearest_word.h"
#include "base/vectors.h"
#include "base/wording.h"
#include "model/objects.h"
#include "repair/soup_measures.h"

namespace geomend::repair {

namespace {

Vec3 middle(const TriangleSoup& soup, const BorderEdge& e) { return times(0.5, plus(soup.vertices[e.from], soup.vertices[e.to])); }

double length_of(const TriangleSoup& soup, const BorderEdge& e) {
    const Vec3 along = minus(soup.vertices[e.to], soup.vertices[e.from]);
    return std::sqrt(dot(along, along));
}

struct Votes {
    double length = 0, ahead = 0, behind = 0, attached = 0;
    double gaps = 0, largest = 0;
    std::map<std::uint32_t, double> by_patch;      ///< what lies ahead
    std::map<std::uint32_t, double> beside_patch;  ///< what is touched or stuck through
};

/// \param hits of the edges ahead
Votes count_votes(const TriangleSoup& soup, const FreeBorders& borders, const std::vector<std::uint32_t>& piece, const GapSearch& search,
                  double tolerance, std::vector<GapHit>& hits) {
    Votes votes;
    for (const std::uint32_t e : piece) {
        const BorderEdge& edge = borders.edges[e];
        const double length = length_of(soup, edge);
        const std::uint32_t patch = soup.patches[edge.triangle];
        const Vec3 from = middle(soup, edge);
        votes.length += length;
        const GapHit back = search.ahead(from, times(-1, edge.outward), patch);
        hits[e] = search.ahead(from, edge.outward, patch);
        const bool touches_ahead = hits[e].within && hits[e].along <= tolerance / 32;
        if (touches_ahead || (back.within && back.along <= tolerance / 32)) {
            votes.attached += length;
            votes.beside_patch[touches_ahead ? hits[e].patch : back.patch] += length;
            hits[e] = {};
            continue;
        }
        if (back.within && (!hits[e].found() || !hits[e].within || back.along <= hits[e].along)) {
            votes.behind += length;
            votes.beside_patch[back.patch] += length;
            hits[e] = {};
            continue;
        }
        if (!hits[e].found()) continue;
        votes.ahead += length;
        votes.gaps += length * hits[e].along;
        votes.largest = std::max(votes.largest, hits[e].along);
        votes.by_patch[hits[e].patch] += length;
    }
    return votes;
}

std::uint32_t most_of(const std::map<std::uint32_t, double>& patches) {
    if (patches.empty()) return no_index;
    return std::ranges::max_element(patches, {}, [](const auto& v) { return v.second; })->first;
}

constexpr const char* nothing_ahead = "no surface lies ahead within the limit";

int percent_of(double part, double whole) { return static_cast<int>(100 * part / whole); }

/// The patch from one side of which to the other a piece goes over: it stops short of it, sticks through it and ends on it along
/// at least 60 % of its length; no_index: none.
std::uint32_t gone_over(const Votes& votes) {
    for (const auto& [patch, ahead] : votes.by_patch) {
        const auto beside = votes.beside_patch.find(patch);
        if (beside != votes.beside_patch.end() && ahead + beside->second >= 0.6 * votes.length) return patch;
    }
    return no_index;
}

void decide(const Votes& votes, Contact& contact) {
    contact.on = votes.ahead > 0 ? most_of(votes.by_patch) : most_of(votes.beside_patch);
    if (votes.ahead > 0) {
        contact.mean_gap = votes.gaps / votes.ahead;
        contact.max_gap = votes.largest;
    }
    const std::uint32_t over = votes.ahead < 0.6 * votes.length ? gone_over(votes) : no_index;
    if (over != no_index) {
        contact.on = over;
        contact.decision = GapDecision::closed;
        contact.in_part = true;
        contact.why = std::to_string(percent_of(votes.by_patch.at(over), votes.length)) +
                      " % of it stops short; the rest ends on it already, or sticks through and is trimmed";
    } else if (votes.attached > 0.6 * votes.length) {
        contact.why = "it ends on another surface already";
    } else if (votes.behind > votes.ahead && votes.behind > 0.6 * votes.length) {
        contact.decision = GapDecision::trimmed;
        contact.why = "it sticks through another surface";
    } else if (votes.ahead >= 0.6 * votes.length) {
        contact.decision = GapDecision::closed;
    } else {
        contact.why = votes.ahead > 0 ? "only " + std::to_string(percent_of(votes.ahead, votes.length)) +
                                            " % of it has a surface ahead within the limit"
                                      : nothing_ahead;
    }
}

/// Says of a piece that has nothing ahead what lies near it all the same, and where.
void explain(const TriangleSoup& soup, const FreeBorders& borders, const GapSearch& search, double tolerance, Contact& contact) {
    NearestHit nearest;
    bool along = false;
    constexpr double cosine_of_along = 0.94;  // 20 degrees
    for (const std::uint32_t e : borders.pieces[contact.piece]) {
        const BorderEdge& edge = borders.edges[e];
        const NearestHit hit = search.nearest({soup.vertices[edge.from], soup.vertices[edge.to]}, edge.outward, contact.patch);
        if (!hit.found() || (nearest.found() && hit.distance >= nearest.distance)) continue;
        nearest = hit;
        const Vec3 normal = triangle_normal(soup, edge.triangle);
        along = std::abs(dot(normal, hit.normal)) > cosine_of_along * std::sqrt(dot(normal, normal));
    }
    if (!nearest.found()) return;
    constexpr double oblique = 0.5;  // 60 degrees
    contact.on = nearest.patch;
    contact.why += "; the nearest one ";
    if (nearest.distance <= tolerance) {
        contact.why += "touches it at a point or beside it";
        return;
    }
    contact.why += "is " + rounded(nearest.distance) + " away, ";
    if (along) contact.why += "and both run along each other, within 20 degrees";
    else if (nearest.ahead < -oblique) contact.why += "behind the border";
    else if (nearest.ahead > oblique)
        contact.why += nearest.grazing ? "and is met at less than 10 degrees" : "and ends before it would be met";
    else contact.why += "beside the border";
}

void obey(std::span<const PatchWish> wishes, Contact& contact) {
    for (const PatchWish& wish : wishes) {
        if (wish.patch != contact.patch || (wish.on != no_index && wish.on != contact.on)) continue;
        const bool can_close = contact.max_gap > 0;
        contact.in_part &= wish.close;
        contact.decision = wish.close && can_close ? GapDecision::closed : GapDecision::left;
        contact.why = wish.close && !can_close ? "to be closed by the recipe, but no surface lies ahead within the limit" : "by the recipe";
    }
}

/// The patches of a name. Failure (usage) where there is none.
Result<std::vector<std::uint32_t>> patches_named(const SurfaceModel& model, const ContactWish& wish, const std::string& name) {
    const auto& patches = model.model.patches;
    std::vector<std::uint32_t> found;
    for (std::uint32_t p = 0; p < patches.size(); ++p) {
        if (patches[p].name == name || patches[p].interface_name == name) found.push_back(p);
    }
    if (!found.empty()) return found;
    std::vector<std::string_view> known;
    for (const auto& patch : patches) known.insert(known.end(), {patch.name, patch.interface_name});
    return failure(FailureKind::usage, "F018", wish.where, "there is no surface " + quoted(name) + nearest_hint(name, known));
}

}  // namespace

Result<std::vector<PatchWish>> patch_wishes(const SurfaceModel& model, std::span<const ContactWish> wishes) {
    std::vector<PatchWish> result;
    for (const ContactWish& wish : wishes) {
        const auto borders = patches_named(model, wish, wish.border);
        if (!borders) return borders.why();
        std::vector<std::uint32_t> on{no_index};  // any
        if (!wish.on.empty()) {
            auto named = patches_named(model, wish, wish.on);
            if (!named) return std::move(named).why();
            on = std::move(*named);
        }
        for (const std::uint32_t p : *borders) {
            for (const std::uint32_t q : on) result.push_back({p, q, wish.close});
        }
    }
    return result;
}

const char* to_string(GapDecision decision) {
    constexpr const char* words[] = {"left", "closed", "trimmed"};
    return words[static_cast<std::size_t>(decision)];
}

std::vector<Contact> decide_contacts(const TriangleSoup& soup, const FreeBorders& borders, const GapSearch& search, double tolerance,
                                     std::span<const PatchWish> wishes, std::vector<GapHit>& hits) {
    hits.assign(borders.edges.size(), {});
    std::vector<Contact> contacts;
    for (std::uint32_t p = 0; p < borders.pieces.size(); ++p) {
        Contact contact;
        contact.piece = p;
        contact.patch = soup.patches[borders.edges[borders.pieces[p].front()].triangle];
        decide(count_votes(soup, borders, borders.pieces[p], search, tolerance, hits), contact);
        if (contact.why == nothing_ahead) explain(soup, borders, search, tolerance, contact);
        obey(wishes, contact);
        contacts.push_back(std::move(contact));
    }
    return contacts;
}

}  // namespace geomend::repair
