// Bytes as text that pages, their scripts and glTF files carry: RFC 4648, section 4.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace shadowbench {

/// With padding, without line breaks.
std::string base64(std::string_view bytes);

/// The bytes, with or without padding; nothing where `text` has another character or ends within a byte.
std::optional<std::string> fromBase64(std::string_view text);

} // namespace shadowbench
