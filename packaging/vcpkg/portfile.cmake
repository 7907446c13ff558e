# From what scripts/release.sh makes: vcpkg install condyle[io] --overlay-ports=packaging/vcpkg. For the registry the publisher puts
# vcpkg_from_github or vcpkg_download_distfile, with the SHA-512 of the published archive, in place of the next two lines.
set(archive "${CURRENT_PORT_DIR}/../../out/release/condyle-${VERSION}.tar.gz")
vcpkg_extract_source_archive(SOURCE_PATH ARCHIVE "${archive}")

vcpkg_check_linkage(ONLY_STATIC_LIBRARY)
vcpkg_check_features(OUT_FEATURE_OPTIONS feature_options FEATURES io CONDYLE_IO)
vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS ${feature_options} -DCONDYLE_C=OFF -DCONDYLE_PYTHON=OFF -DCONDYLE_TESTS=OFF -DCONDYLE_UNITY=ON -DCONDYLE_HDF5_INSIDE=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/condyle)
vcpkg_fixup_pkgconfig()
if("io" IN_LIST FEATURES)
  vcpkg_copy_tools(TOOL_NAMES condyle AUTO_CLEAN)
endif()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share" "${CURRENT_PACKAGES_DIR}/share/doc")

file(INSTALL "${CURRENT_PORT_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
file(GLOB bundled "${SOURCE_PATH}/viewer/licences/*.txt")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE" "${SOURCE_PATH}/NOTICE" ${bundled})
