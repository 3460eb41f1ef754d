// SPDX-License-Identifier: MIT
#include "yaml.hpp"

namespace banyan::config {

Node parse_yaml(const std::string& path, std::string_view /*text*/) {
  throw DocumentError({{std::make_shared<const std::string>(path), 0},
                       "",
                       "YAML needs libyaml, which this banyan was built without; install libyaml-dev and build again, "
                       "or name the picture itself as the file and give resolution_m and origin_m"});
}

}  // namespace banyan::config
