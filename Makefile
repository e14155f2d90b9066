# The loop of a contributor; CONTRIBUTING.md explains it. PYTHON, JOBS and ARGS can be set: make test ARGS='-k sweep'.
PYTHON ?= python
JOBS ?= auto
CORE = types loading geometry scoring motion segmentation articulation physics rendering export pipeline isolation cli

.PHONY: lint test test-all docs

lint:
	$(PYTHON) -m ruff check
	$(PYTHON) -m ruff format --check
	$(PYTHON) -m ty check -q --python $$($(PYTHON) -c 'import sys; print(sys.prefix)')
	$(PYTHON) -m codespell_lib
	$(PYTHON) -m codespell_lib --dictionary .ci/glossary.txt src docs tests benchmarks training examples findings *.md

test:
	$(PYTHON) -m pytest -n $(JOBS) tests/test_layers.py tests/test_words.py $(wildcard $(CORE:%=tests/%)) $(ARGS)

test-all:
	$(PYTHON) -m pytest -n $(JOBS) $(ARGS)

docs:
	$(PYTHON) -m sphinx -W -q -c docs . out/site
