# SPDX-License-Identifier: AGPL-3.0-or-later
# The library of CGNS with its mid-level interface, and the HDF5 that it stands on: CgnsLibrary_LIBRARIES and CgnsLibrary_INCLUDE_DIRS.
# Named apart from the module of VTK.
find_path(CgnsLibrary_INCLUDE_DIR cgnslib.h)
find_library(CgnsLibrary_LIBRARY NAMES cgns)
find_path(CgnsLibrary_HDF5_INCLUDE_DIR H5public.h PATH_SUFFIXES hdf5/serial)
find_library(CgnsLibrary_HDF5 NAMES hdf5_serial hdf5)
set(CgnsLibrary_LIBRARIES ${CgnsLibrary_LIBRARY} ${CgnsLibrary_HDF5})
set(CgnsLibrary_INCLUDE_DIRS ${CgnsLibrary_INCLUDE_DIR} ${CgnsLibrary_HDF5_INCLUDE_DIR})
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CgnsLibrary REQUIRED_VARS CgnsLibrary_LIBRARY CgnsLibrary_INCLUDE_DIR CgnsLibrary_HDF5
    CgnsLibrary_HDF5_INCLUDE_DIR)
mark_as_advanced(CgnsLibrary_INCLUDE_DIR CgnsLibrary_LIBRARY CgnsLibrary_HDF5 CgnsLibrary_HDF5_INCLUDE_DIR)
