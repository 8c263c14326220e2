# SPDX-License-Identifier: AGPL-3.0-or-later
# The library of CGNS with its mid-level interface: CgnsLibrary_LIBRARY and CgnsLibrary_INCLUDE_DIR. Named apart from the module of VTK.
find_path(CgnsLibrary_INCLUDE_DIR cgnslib.h)
find_library(CgnsLibrary_LIBRARY NAMES cgns)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CgnsLibrary REQUIRED_VARS CgnsLibrary_LIBRARY CgnsLibrary_INCLUDE_DIR)
mark_as_advanced(CgnsLibrary_INCLUDE_DIR CgnsLibrary_LIBRARY)
