#include "clca/record/provenance.hpp"

namespace clca::record {

std::string version() {
  return CLCA_VERSION;
}

store::RunSummary provenance() {
  store::RunSummary summary;
  summary.version = version();
  summary.compiler = CLCA_COMPILER;
  summary.build_type = CLCA_BUILD_TYPE;
  return summary;
}

}  // namespace clca::record
