// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "arrangement/arrange.h"

namespace geomend::repair {

/// Cuts that took many rounds, of which plans that begin alike would do the same ones again: the last few.
class KnownCuts {
public:
    /// The cut of the same soup with the same options; nothing where it is not known.
    std::shared_ptr<const arrangement::Arrangement> find(const TriangleSoup& soup, const arrangement::ArrangeOptions& options) const {
        for (const Known& known : known_) {
            const TriangleSoup& s = known.soup;
            const bool is_same = known.tolerance == options.tolerance && known.reach == options.reach && known.sheets == options.sheets &&
                                 known.most_rounds == options.most_rounds && s.vertices == soup.vertices && s.triangles == soup.triangles &&
                                 s.patches == soup.patches && s.edges == soup.edges && s.edge_ids == soup.edge_ids;
            if (is_same) return known.cut;
        }
        return nullptr;
    }

    /// Keeps a cut where it took long; forgets the oldest.
    void add(const TriangleSoup& soup, const arrangement::ArrangeOptions& options, const arrangement::Arrangement& cut) {
        constexpr unsigned few_rounds = 12;
        constexpr std::size_t most_known = 8;
        if (cut.rounds <= few_rounds) return;
        if (known_.size() == most_known) known_.erase(known_.begin());
        known_.push_back({soup, options.tolerance, options.reach, options.most_rounds, options.sheets,
                          std::make_shared<const arrangement::Arrangement>(cut)});
    }

private:
    struct Known {
        TriangleSoup soup;
        double tolerance, reach;
        unsigned most_rounds;
        bool sheets;
        std::shared_ptr<const arrangement::Arrangement> cut;
    };
    std::vector<Known> known_;
};

}  // namespace geomend::repair
