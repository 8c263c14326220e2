// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace geomend::vtk {

/// One element of an XML document. Children of one element are linked by `next`; 0 ends the list, because
/// element 0 is the root and nobody's child.
struct XmlElement {
    std::string_view name;
    std::string_view text;   ///< its first text that is not blank, without blanks at either end; entities as they stand
    std::size_t offset = 0;  ///< of its '<'
    std::uint32_t first_attribute = 0, attribute_count = 0;
    std::uint32_t first_child = 0, next = 0;
    bool text_in_pieces = false;  ///< there is more text, after a child
};

/// An XML document as VTK writes it, over bytes that stay where they are. The bytes after the '_' of an
/// AppendedData element are not looked at: they may be anything.
struct XmlDocument {
    std::string file;  ///< name for messages
    std::string_view bytes;
    struct Attribute {
        std::string_view name, value;
    };
    std::vector<XmlElement> elements;
    std::vector<Attribute> attributes;
    std::string_view appended;  ///< what stands between '_' and the last </AppendedData>
    bool has_appended = false;

    const XmlElement& root() const { return elements.front(); }
    /// Value of an attribute with its entities resolved; empty where there is none.
    std::string attribute(const XmlElement& element, std::string_view name) const;
    /// Value as it stands, or an empty view; `found` (optional) tells an empty value from none.
    std::string_view raw_attribute(const XmlElement& element, std::string_view name, bool* found = nullptr) const;
    /// First child of that name after `after` (from the start for nullptr), or nullptr.
    const XmlElement* child(const XmlElement& element, std::string_view name, const XmlElement* after = nullptr) const;
    /// All children in order. Cost: none but the vector.
    std::vector<const XmlElement*> children(const XmlElement& element) const;
    /// Line and column of a byte; counted anew each time, so for messages only.
    Location where(std::size_t offset) const;
    Location where(const XmlElement& element) const { return where(element.offset); }
    /// The same for text inside `bytes`.
    Location where(std::string_view text) const { return where(static_cast<std::size_t>(text.data() - bytes.data())); }
};

/// Scans a document. Failures: F004 where it ends too early, F012 where it is not well formed, F013 for encodings other than
/// UTF-8 and for inner document types, F014 for more than 200 nested elements. Cost: one pass over the XML part.
Result<XmlDocument> scan_xml(std::string_view bytes, const std::string& file);

/// Text with &lt; &gt; &amp; &quot; &apos; and character numbers resolved; other entities stay as they are.
std::string resolve_entities(std::string_view text);

}  // namespace geomend::vtk
