# The two commands that matter: make demo, make test. Each works from a fresh clone on Debian 12.
BUILD  := build
PRESET ?= release
OUT    := out/demo
LIVE   := out/live
SOAK_S ?= 600
SUDO   := $(shell [ "$$(id -u)" = 0 ] || echo sudo)
# Whatever reads what others wrote, shares memory between threads or counts its own way through
# arrays. CI, which has minutes, narrows it.
SANITIZED ?= core config dataset intrinsics trajectory pcd image output mesh detections oni sim graph \
             planes reachability region_growing segments eval
# Empty: all of .clang-tidy. CI, which has minutes, narrows it.
TIDY_CHECKS ?=
# Of so many last commits the files that they touched; empty: all files.
TIDY_COMMITS ?=
TIDIED = $(if $(TIDY_COMMITS),git log -n $(TIDY_COMMITS) --name-only --pretty=format:,git ls-files)
SOURCES = $(shell git ls-files '*.cpp' '*.hpp')

.PHONY: demo demo-live soak drivers test build deps bench scores docs thesis-results lint sanitize format help
help:            ## what there is
	@grep -E '^[a-z-]+: .*## ' Makefile | sed -E 's/:.*## /\t/'

demo: build      ## a simulated room in, a belief and its pictures out
	$(BUILD)/bin/credo run --source sim:first-light --out $(OUT) --dump labels,pictures
	@echo "Look at $(OUT)/pictures/ and $(OUT)/belief.jsonl"

demo-live: drivers ## the same from a (virtual) sensor, in real time
	rm -rf $(LIVE)
	$(BUILD)/bin/credo simulate scenes/live/table.yaml --out $(LIVE)/data
	echo '{"sensors": [{"name": "demo", "dataset": "data", "rate_hz": 10, "play": "once"}]}' > $(LIVE)/sensor.json
	LD_LIBRARY_PATH=$(CURDIR)/$(BUILD)/openni2 CREDO_VIRTUAL_SENSOR=$(CURDIR)/$(LIVE)/sensor.json \
	  $(BUILD)/bin/credo run --source openni:virtual://demo --frames 90 --no-dds --out $(LIVE)/run --dump pictures
	@echo "Look at $(LIVE)/run/pictures/ and $(LIVE)/run/belief.jsonl"

soak: drivers    ## SOAK_S seconds at 30 Hz from a virtual sensor: nothing lost, memory flat
	tools/soak.py $(BUILD)/bin/credo $(BUILD)/openni2 out/soak $(SOAK_S)

drivers: build   ## the modules for OpenNI2
	cmake --build --preset $(PRESET) --target credo_virtual credo_freenect

test: deps       ## build and run every test
	cmake --preset $(PRESET) --log-level=WARNING
	cmake --build --preset $(PRESET)
	ctest --test-dir $(BUILD) --output-on-failure -j2

build: deps      ## build/bin/credo
	cmake --preset $(PRESET) --log-level=WARNING
	cmake --build --preset $(PRESET) --target credo

deps:            ## install what packages.txt lists and this machine lacks
	@missing=$$(grep -v '^#' packages.txt | while read -r p; do \
	  dpkg-query -W -f='$${Status}' $$p 2>/dev/null | grep -q 'ok installed' || echo $$p; done); \
	if [ -n "$$missing" ]; then echo "Installing:" $$missing; \
	  $(SUDO) apt-get update -qq && \
	  DEBIAN_FRONTEND=noninteractive $(SUDO) apt-get install -y -qq --no-install-recommends $$missing; fi

bench: deps      ## ours beside PCL's, on the same frames in the same run
	cmake --preset bench --log-level=WARNING
	cmake --build --preset bench
	@for b in $(BUILD)/bin/*_bench; do $$b || exit 1; done

scores: build    ## every scene simulated, run with both presets and scored: docs/scores.md, docs/reliability.svg
	tools/score_scenes.py $(BUILD)/bin/credo out/scores --markdown docs/scores.md \
	  --reliability docs/reliability.svg --recordings $${CREDO_DATA:-../shared/data}

docs: build      ## config/default.yaml and docs/config.md, as the program prints them
	$(BUILD)/bin/credo config > config/default.yaml
	$(BUILD)/bin/credo config --markdown > docs/config.md

thesis-results: deps ## docs/thesis-results.md and its figures, from runs of the thesis' scenes
	cmake --preset $(PRESET) --log-level=WARNING
	cmake --build --preset $(PRESET) --target credo_thesis_results
	$(BUILD)/bin/credo_thesis_results docs/thesis-results.md docs/thesis

lint: deps       ## clang-format and clang-tidy, findings are errors
	clang-format --dry-run --Werror $(SOURCES)
	cmake --preset $(PRESET) --log-level=WARNING
	cmake --build --preset $(PRESET) --target credo_dds  # for the headers made of IDL
	@files=$$($(TIDIED) | grep -E '^(src|tools)/.*\.cpp$$' | sort -u | while read -r f; do \
	  if [ -f "$$f" ]; then echo "/$$f\$$"; fi; done); \
	echo "clang-tidy of $$(echo $$files | wc -w) files"; \
	[ -z "$$files" ] || run-clang-tidy -quiet -j2 -checks='$(TIDY_CHECKS)' -p $(BUILD) $$files

sanitize: deps   ## the suites where memory is at stake, under ASan and UBSan
	cmake --preset sanitize --log-level=WARNING
	cmake --build --preset sanitize --target $(patsubst %,credo_%_test,$(SANITIZED))
	ctest --preset sanitize -j2 -E NOT_BUILT

format:          ## clang-format in place
	clang-format -i $(SOURCES)
