// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/roff/write_parameters.h"

#include <algorithm>
#include <set>

#include "formats/roff/read_roff.h"
#include "formats/roff/subgrids.h"
#include "formats/roff/tag_text.h"

namespace geomend::roff {

namespace {

template <class T>
constexpr T missing_of() {
    if constexpr (std::is_same_v<T, std::uint8_t>) {
        return static_cast<T>(missing_byte);
    } else {
        return static_cast<T>(missing_real);
    }
}

class ParameterWriter {
public:
    ParameterWriter(TokenWriter& to, const CornerPointGrid& grid, std::vector<Loss>& losses) : to_(to), grid_(grid), losses_(losses) {}

    void run() {
        for (const Attribute& a : grid_.info.attributes) {
            if (a.location != AttributeLocation::cell || a.components == 0 || value_count(a) != grid_.cell_count() * a.components) {
                lose(LossClass::substance, "attribute '" + a.name + "'", "ROFF files hold values of cells");
                continue;
            }
            if (a.name == subgrid_name && says_subgrids(a)) continue;  // the tag says it
            if (!a.unit.empty()) lose(LossClass::identity, "unit of attribute '" + a.name + "'", "ROFF files have no place for it");
            for (std::uint32_t c = 0; c < a.components; ++c) {
                std::visit([&](const auto& values) { write(a, c, values); }, a.values);
            }
        }
    }

private:
    void lose(LossClass c, std::string what, std::string why) { add_loss(losses_, {c, grid_.info.name, std::move(what), std::move(why)}); }

    bool says_subgrids(const Attribute& a) const {
        const auto made = subgrid_attribute(grid_);
        return made && made->values == a.values;
    }

    std::string parameter_name(const Attribute& a, std::uint32_t component) {
        std::string name = a.components > 1 ? a.name + "_" + std::to_string(component + 1) : a.name;
        const std::string wish = name;
        for (std::size_t n = 2; taken_.contains(name); ++n) name = wish + "_" + std::to_string(n);
        taken_.insert(name);
        if (name != a.name) {
            lose(LossClass::identity, "name of attribute '" + a.name + "', written as '" + name + "'",
                 a.components > 1 ? "parameters hold one value a cell" : "names are used once");
        }
        return name;
    }

    /// One component in the order of the file.
    template <class To, class From>
    std::vector<To> gathered(const Attribute& a, std::uint32_t component, const std::vector<From>& values) const {
        const auto [nx, ny, nz] = grid_.dims;
        std::vector<To> out;
        out.reserve(grid_.cell_count());
        for (std::uint32_t i = 0; i < nx; ++i) {
            for (std::uint32_t j = 0; j < ny; ++j) {
                for (std::uint32_t k = nz; k-- > 0;) out.push_back(static_cast<To>(values[grid_.cell(i, j, k) * a.components + component]));
            }
        }
        return out;
    }

    /// Makes missing values those that stand for missing here.
    template <class T>
    void set_missing(const Attribute& a, std::vector<T>& values) {
        if (!a.no_data || *a.no_data == static_cast<double>(missing_of<T>())) return;
        if (std::ranges::find(values, missing_of<T>()) != values.end()) {
            lose(LossClass::identity, "no-data value of attribute '" + a.name + "'",
                 "the value that stands for missing in ROFF files is in use");
            return;
        }
        for (T& v : values) {
            if (is_no_data(a, static_cast<double>(v))) v = missing_of<T>();
        }
    }

    void write_codes(const Attribute& a) {
        if (a.code_names.empty()) return;
        std::vector<std::string> names;
        std::vector<std::int32_t> codes;
        for (const auto& [code, name] : a.code_names) {
            names.push_back(name);
            codes.push_back(code);
        }
        to_.array("codeNames", names);
        to_.array("codeValues", codes);
    }

    void write_kept(const Attribute& a) {
        for (const auto& [key, text] : a.annotations) {
            if (key != "roff.entry") continue;
            const auto kept = tag_from_text("tag kept\n" + text + "\nendtag\n");
            if (!kept) continue;
            for (const Entry& entry : kept->tags.front().entries) write_entry(to_, *kept, entry);
        }
    }

    template <class T>
    void write(const Attribute& a, std::uint32_t component, const std::vector<T>& values) {
        constexpr bool real = std::is_floating_point_v<T>, text = std::is_same_v<T, std::string>, byte = std::is_same_v<T, std::uint8_t>;
        if constexpr (!real && !text && !byte) {
            if (!std::ranges::all_of(values, [](T v) { return std::in_range<std::int32_t>(v); })) {
                lose(LossClass::substance, "attribute '" + a.name + "'", "a value does not fit a whole number of 32 bits");
                return;
            }
        }
        using Stored = std::conditional_t<real || text || byte, T, std::int32_t>;
        auto out = gathered<Stored>(a, component, values);
        to_.begin_tag("parameter");
        to_.value("name", std::string_view(parameter_name(a, component)));
        write_codes(a);
        if constexpr (byte) {
            const auto logical = [](const std::pair<std::string, std::string>& n) { return n.second == "bool" || n.second == "LOGI"; };
            const bool boolean =
                std::ranges::any_of(a.annotations, logical) && std::ranges::all_of(out, [](std::uint8_t v) { return v <= 1; });
            if (!boolean) set_missing(a, out);
            to_.array("data", out, boolean);
        } else {
            if constexpr (!text) set_missing(a, out);
            to_.array("data", out);
        }
        write_kept(a);
        to_.end_tag();
    }

    TokenWriter& to_;
    const CornerPointGrid& grid_;
    std::vector<Loss>& losses_;
    std::set<std::string> taken_;
};

}  // namespace

void write_parameters(TokenWriter& to, const CornerPointGrid& grid, std::vector<Loss>& losses) { ParameterWriter(to, grid, losses).run(); }

}  // namespace geomend::roff
