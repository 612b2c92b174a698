# The two commands are `make run` and `make test`; `make help` lists the rest.
SHELL := /bin/bash
.SHELLFLAGS := -eu -o pipefail -c
.DEFAULT_GOAL := help
.NOTPARALLEL:

PREFIX ?= /usr/local
JOBS   ?= $(shell env -u OMP_NUM_THREADS nproc)
CASE   := examples/shear-subcritical.toml
RUN    := out/shear-subcritical

# One thread per process: the processes share the cores, and results do not depend on their number.
export OMP_NUM_THREADS := 1
export OPENBLAS_NUM_THREADS := 1
export OMPI_ALLOW_RUN_AS_ROOT := 1
export OMPI_ALLOW_RUN_AS_ROOT_CONFIRM := 1
ifneq ($(shell command -v ccache),)
export CMAKE_C_COMPILER_LAUNCHER := ccache
export CMAKE_CXX_COMPILER_LAUNCHER := ccache
endif

define build # preset, further options
cmake --preset $(1) $(2) > /dev/null
cmake --build --preset $(1) -j $(JOBS)
endef

.PHONY: help
help: ## this list
	@awk -F ':.*## ' '/^[a-z-]+:.*## /{printf "make %-13s %s\n", $$1, $$2}' Makefile

.PHONY: run
run: ## install what is missing, build, simulate a drop in simple shear
	@scripts/setup.sh run
	@$(call build,release)
	@build/release/meniscus run $(CASE) -o $(RUN) --overwrite
	@echo "Pictures: $(CURDIR)/$(RUN)/report.html (any browser), $(RUN)/surface.pvd (ParaView)"

.PHONY: test
test: ## install what is missing, build, run every test and a short case
	@scripts/setup.sh test
	@$(call build,test,-DMENISCUS_LONG_TESTS=OFF -DMENISCUS_BENCH=OFF)
	@ctest --preset test -j $(JOBS)

.PHONY: check
check: ## format, layers, citations and metadata only; nothing is compiled
	@scripts/setup.sh test
	@scripts/check_format.sh
	@python3 -B tests/layers/check_layers.py .
	@python3 -B tests/citations/check_citations.py .
	@python3 -B tests/metadata/check_metadata.py .

.PHONY: check-long
check-long: ## clang-tidy, benchmarks built, the long suites, every test and 10,000 broken inputs under the sanitizers
	@scripts/setup.sh long
	@$(call build,test,-DMENISCUS_LONG_TESTS=ON -DMENISCUS_BENCH=ON)
	@scripts/check_tidy.sh build/test
	@ctest --preset test -j $(JOBS)
	@$(call build,dev)
	@ctest --preset dev -j $(JOBS)
	@UBSAN_OPTIONS=halt_on_error=1 ASAN_OPTIONS=detect_leaks=0 \
	  python3 tests/end_to_end/fuzz.py build/dev/meniscus build/dev/tests/fuzz-long 10000
	@python3 tests/end_to_end/random_steps.py build/test/meniscus build/test/tests/random-steps 300

.PHONY: coverage
coverage: ## which lines the tests reach: out/coverage/index.html
	@scripts/setup.sh coverage
	@$(call build,coverage)
	@find build/coverage -name '*.gcda' -delete
	@ctest --preset coverage -j $(JOBS)
	@mkdir -p out/coverage
	@gcovr -j $(JOBS) -r . --object-directory build/coverage -f meniscus/ \
	  --exclude-throw-branches --html-details out/coverage/index.html --print-summary

.PHONY: format
format: ## lay out every C++ source as .clang-format says
	@scripts/setup.sh test
	@scripts/check_format.sh --fix

.PHONY: docs
docs: ## the site of all pages and of the C++ interface: out/site/index.html
	@scripts/setup.sh docs
	@python3 -B site/build.py out/site
	@python3 -B site/check_links.py out/site
	@echo "Site: $(CURDIR)/out/site/index.html; make docs-serve shows it with its search"

.PHONY: docs-serve
docs-serve: docs ## the same, served to this machine alone: http://127.0.0.1:8000/
	@python3 -m http.server 8000 --bind 127.0.0.1 --directory out/site

.PHONY: install
install: ## build and install the program and the library under PREFIX=/usr/local
	@scripts/setup.sh run
	@$(call build,release,-UMENISCUS_PYTHON_DIR)
	@cmake --install build/release --prefix '$(PREFIX)'

.PHONY: deb
deb: ## build Debian packages of the program and of the library: build/release/deb/*.deb
	@scripts/setup.sh deb
	@$(call build,release,-DMENISCUS_PYTHON_DIR=lib/python3/dist-packages)
	@rm -rf build/release/deb
	@cpack --config build/release/CPackConfig.cmake > build/release/cpack.log || { cat build/release/cpack.log; exit 1; }
	@rm -rf build/release/deb/_CPack_Packages
	@for file in build/release/deb/*.deb; do du -h "$$file"; dpkg-deb --field "$$file" Package Version Installed-Size Depends; done

.PHONY: check-release
check-release: deb docs ## the packages, the notebooks and the Containerfile in bare Debians, the site, Slurm, CGAL's surfaces (as root; CACHE=a folder of ccache's)
	@scripts/setup.sh release
	@python3 -B tests/release/packages.py build/release/deb
	@python3 -B tests/release/container.py . $(CACHE)
	@python3 -B tests/release/slurm.py build/release/meniscus
	@python3 -B tests/release/remesh_surfaces.py build/release/meniscus out/surfaces

.PHONY: clean
clean: ## remove build trees and output
	@rm -rf build out
