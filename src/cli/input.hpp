#pragma once
// Errors of what the user gave.

#include <utility>

#include "clca/store/file.hpp"
#include "clca/store/folder_lock.hpp"
#include "clca/text/input_error.hpp"

namespace clca::cli {

/// What `read` returns. A file that it cannot read is wrong input: throws text::InputError.
template <class Read>
auto as_input(Read&& read) {
  try {
    return std::forward<Read>(read)();
  } catch (const store::FolderLockError&) {
    throw;  // the folder is there, but cannot be written
  } catch (const store::StoreError& error) {
    throw text::InputError(error.what());
  }
}

}  // namespace clca::cli
