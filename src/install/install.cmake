# What `cmake --install` and the Debian package hold: PREFIX/bin, and the rest in PREFIX/share.
include(GNUInstallDirs)
set(own ${CMAKE_INSTALL_DATADIR}/ricochet)
set(papers ${CMAKE_INSTALL_DATADIR}/doc/ricochet)
install(TARGETS ricochet)
install(DIRECTORY lua scripts examples DESTINATION ${own})
install(FILES README.md CHANGELOG.md DESTINATION ${papers})
install(FILES LICENSE DESTINATION ${papers} RENAME copyright)
install(FILES src/install/ricochet.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES src/install/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME ricochet)

# `cpack --config .build/portable/CPackConfig.cmake`: a package for every x86-64 processor that the portable build is for.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME ricochet)
set(CPACK_PACKAGE_CONTACT "the authors of ricochet <ricochet@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Loaded or called at run time, where no linker sees them.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libosmesa6, fonts-dejavu-core, gnuplot-nox | gnuplot")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS ffmpeg)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "slurm-client, fonts-noto-cjk")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "workbench for the impact of elastic bodies
 Random lattices of springs, finite elements or modes collide in sweeps over
 thousands of impacts. Scripts in Lua; results as HDF5, CSV, plots and films.")
# The tests are no part of it, and need not be built for it.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
include(CPack)
