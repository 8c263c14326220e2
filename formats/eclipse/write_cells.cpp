// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <limits>
#include <set>

#include "base/number_text.h"
#include "base/text_cursor.h"
#include "formats/eclipse/write_common.h"

namespace geomend::eclipse {

namespace {

constexpr std::size_t longest_name = 8, longest_text = 999;

/// An attribute, or the halves of one that two porosities share.
struct Pair {
    std::string name;
    const Attribute* matrix = nullptr;
    const Attribute* fracture = nullptr;
    const Attribute& any() const { return matrix != nullptr ? *matrix : *fracture; }
};

class CellWriter {
public:
    CellWriter(ArrayWriter& writer, const CornerPointGrid& grid, const CellOrder& order, bool active_only, std::string_view title,
               std::vector<Loss>& losses)
        : writer_(writer), grid_(grid), order_(order), active_only_(active_only), title_(title), losses_(losses) {}

    void run() {
        for (const Pair& pair : pairs()) {
            if (active_only_ && pair.name == "PORV") continue;  // of all cells; the caller writes it
            for (std::uint32_t c = 0; c < pair.any().components; ++c) write(pair, c);
        }
    }

private:
    void lose(LossClass c, std::string what, std::string why) { add_loss(losses_, {c, grid_.info.name, std::move(what), std::move(why)}); }

    std::vector<Pair> pairs() {
        std::vector<Pair> all;
        for (const Attribute& a : grid_.info.attributes) {
            if (a.location != AttributeLocation::cell || a.components == 0 || value_count(a) != order_.cells * a.components) {
                lose(LossClass::substance, "attribute '" + a.name + "'", std::string(title_) + " files hold values of cells");
                continue;
            }
            const bool fracture = order_.dual && a.name.ends_with(fracture_suffix);
            const std::string name = fracture ? a.name.substr(0, a.name.size() - fracture_suffix.size()) : a.name;
            const auto known = std::ranges::find_if(all, [&](const Pair& p) {
                return order_.dual && p.name == name && (fracture ? p.fracture : p.matrix) == nullptr &&
                       p.any().values.index() == a.values.index() && p.any().components == a.components;
            });
            Pair& pair = known != all.end() ? *known : all.emplace_back();
            pair.name = name;
            (fracture ? pair.fracture : pair.matrix) = &a;
        }
        return all;
    }

    /// At most eight characters, each name once.
    std::string array_name(const Pair& pair, std::uint32_t component) {
        const bool several = pair.any().components > 1;
        std::string wish = pair.name + (several ? "_" + std::to_string(component + 1) : "");
        std::string name = wish.substr(0, longest_name);
        for (char& c : name) {
            if (c < ' ' || c > '~' || c == '\'') c = '_';
        }
        if (trimmed(name).empty()) name = "ARRAY";
        for (std::size_t n = 2; taken_.contains(name); ++n) {
            const std::string digits = std::to_string(n);
            name = wish.substr(0, longest_name - std::min(longest_name, digits.size())) + digits;
        }
        taken_.insert(name);
        if (name != pair.name) {
            lose(LossClass::identity, "name of attribute '" + pair.name + "', written as '" + name + "'",
                 several ? "arrays hold one value a cell" : "names have at most 8 characters, each once");
        }
        return name;
    }

    void write(const Pair& pair, std::uint32_t component) {
        const std::string name = array_name(pair, component);
        const Attribute& a = pair.any();
        if (!a.unit.empty() && a.unit != unit_of(name, grid_.unit_system))
            lose(LossClass::identity, "unit of attribute '" + a.name + "'", why_not());
        if (!a.code_names.empty()) lose(LossClass::identity, "code names of attribute '" + a.name + "'", why_not());
        if (a.no_data && !active_only_) lose(LossClass::identity, "no-data value of attribute '" + a.name + "'", why_not());
        std::visit([&](const auto& values) { write_values(pair, component, name, values); }, a.values);
    }
    std::string why_not() const { return std::string(title_) + " files have no place for it"; }

    /// The values in the order of the file.
    template <class T>
    std::vector<T> gathered(const Pair& pair, std::uint32_t component) const {
        std::vector<T> out;
        const auto add = [&](const Attribute* a, const std::vector<std::uint64_t>* cells) {
            const std::vector<T>* values = a != nullptr ? std::get_if<std::vector<T>>(&a->values) : nullptr;
            const std::size_t components = pair.any().components;
            const std::size_t count = cells != nullptr ? cells->size() : order_.cells;
            for (std::size_t i = 0; i < count; ++i) {
                const std::size_t cell = cells != nullptr ? (*cells)[i] : i;
                out.push_back(values != nullptr ? (*values)[cell * components + component] : absent<T>(pair.any()));
            }
        };
        const bool some = active_only_ && !order_.all_active;
        out.reserve(some ? order_.active() : order_.total());
        add(pair.matrix, some ? &order_.matrix : nullptr);
        if (order_.dual) add(pair.fracture, some ? &order_.fracture : nullptr);
        return out;
    }

    template <class T>
    static T absent(const Attribute& a) {
        if constexpr (std::is_arithmetic_v<T>) return a.no_data ? static_cast<T>(*a.no_data) : T{};
        return T{};
    }

    template <class T>
    void write_values(const Pair& pair, std::uint32_t component, const std::string& name, const std::vector<T>& all) {
        const bool as_it_is = !order_.dual && pair.any().components == 1 && (!active_only_ || order_.all_active);
        std::vector<T> copy;
        if (!as_it_is) copy = gathered<T>(pair, component);
        const std::vector<T>& values = as_it_is ? all : copy;
        if constexpr (std::is_same_v<T, float>) {
            writer_.floats(name, values);
        } else if constexpr (std::is_same_v<T, double>) {
            writer_.doubles(name, values);
        } else if constexpr (std::is_same_v<T, std::string>) {
            write_texts(name, values);
        } else if constexpr (std::is_same_v<T, std::int32_t>) {
            writer_.integers(name, values);
        } else {
            write_integers(pair, name, values);
        }
    }

    template <class T>
    void write_integers(const Pair& pair, const std::string& name, const std::vector<T>& values) {
        const bool logical = std::ranges::find(pair.any().annotations, std::pair<std::string, std::string>{"eclipse.type", "LOGI"}) !=
                             pair.any().annotations.end();
        if constexpr (std::is_same_v<T, std::uint8_t>) {
            if (logical && std::ranges::all_of(values, [](std::uint8_t v) { return v <= 1; })) return writer_.logicals(name, values);
        }
        const bool fit = std::ranges::all_of(values, [](T v) { return std::in_range<std::int32_t>(v); });
        if (!fit) {
            lose(LossClass::substance, "attribute '" + pair.name + "'", "a value does not fit a whole number of 32 bits");
            return;
        }
        writer_.integers(name, std::vector<std::int32_t>(values.begin(), values.end()));
    }

    void write_texts(const std::string& name, const std::vector<std::string>& values) {
        std::size_t size = longest_name;
        for (const std::string& v : values) size = std::max(size, v.size());
        if (size > longest_text) {
            lose(LossClass::substance, "texts longer than 999 characters of '" + name + "'", "arrays of text hold at most so many");
            size = longest_text;
        }
        writer_.texts(name, values, size);
    }

    ArrayWriter& writer_;
    const CornerPointGrid& grid_;
    const CellOrder& order_;
    bool active_only_;
    std::string_view title_;
    std::vector<Loss>& losses_;
    std::set<std::string> taken_ = {"ACTNUM", "PORV"};
};

}  // namespace

void write_cell_arrays(ArrayWriter& writer, const CornerPointGrid& grid, const CellOrder& order, bool active_only, std::string_view title,
                       std::vector<Loss>& losses) {
    CellWriter(writer, grid, order, active_only, title, losses).run();
}

}  // namespace geomend::eclipse
