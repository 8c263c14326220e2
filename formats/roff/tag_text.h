// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>

#include "formats/roff/document.h"
#include "formats/roff/token_writer.h"

// Tags that the model has no place for are kept as text, as they would stand in a text file, and go back from there.

namespace geomend::roff {

/// A tag with all of its values.
Result<std::string> tag_text(const Document& document, const Tag& tag);
/// One value or array.
Result<std::string> entry_text(const Document& document, const Entry& entry);

/// The tag that a text is of; nothing where it is not such a text.
std::optional<Document> tag_from_text(const std::string& text);

/// Writes an entry of another document.
void write_entry(TokenWriter& writer, const Document& document, const Entry& entry);

}  // namespace geomend::roff
