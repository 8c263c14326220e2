// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/contact_table.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/vectors.h"
#include "model/objects.h"

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
    std::map<std::uint32_t, double> by_patch;
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
        const bool touches = (hits[e].within && hits[e].along <= tolerance / 32) || (back.within && back.along <= tolerance / 32);
        if (touches) {
            votes.attached += length;
            hits[e] = {};
            continue;
        }
        if (back.within && (!hits[e].found() || !hits[e].within || back.along <= hits[e].along)) {
            votes.behind += length;
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

void decide(const Votes& votes, Contact& contact) {
    if (votes.ahead > 0) {
        contact.mean_gap = votes.gaps / votes.ahead;
        contact.max_gap = votes.largest;
        contact.on = std::ranges::max_element(votes.by_patch, {}, [](const auto& v) { return v.second; })->first;
    }
    if (votes.attached > 0.6 * votes.length) {
        contact.why = "it ends on another surface already";
    } else if (votes.behind > votes.ahead && votes.behind > 0.6 * votes.length) {
        contact.decision = GapDecision::trimmed;
        contact.why = "it sticks through another surface";
    } else if (votes.ahead >= 0.6 * votes.length) {
        contact.decision = GapDecision::closed;
    } else {
        const int percent = static_cast<int>(100 * votes.ahead / votes.length);
        contact.why = votes.ahead > 0 ? "only " + std::to_string(percent) + " % of it has a surface ahead within the limit"
                                      : "no surface lies ahead within the limit";
    }
}

void obey(std::span<const PatchWish> wishes, Contact& contact) {
    for (const PatchWish& wish : wishes) {
        if (wish.patch != contact.patch || (wish.on != no_index && wish.on != contact.on)) continue;
        const bool can_close = contact.on != no_index;
        contact.decision = wish.close && can_close ? GapDecision::closed : GapDecision::left;
        contact.why = wish.close && !can_close ? "to be closed by the recipe, but no surface lies ahead within the limit" : "by the recipe";
    }
}

}  // namespace

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
        obey(wishes, contact);
        contacts.push_back(std::move(contact));
    }
    return contacts;
}

}  // namespace geomend::repair
