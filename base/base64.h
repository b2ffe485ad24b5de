// Bytes as text that pages and their scripts carry: RFC 4648, section 4.
#pragma once

#include <string>
#include <string_view>

namespace shadowbench {

/// With padding, without line breaks.
std::string base64(std::string_view bytes);

} // namespace shadowbench
