# SPDX-License-Identifier: Apache-2.0
"""The completed checklist of reproducible artifacts."""

from typing import Any

from ..blocks import Table
from . import Material


def section(material: Material) -> dict[str, Any]:
    benches = material.results.benches
    dirty = [bench.name for bench in benches if bench.environment["git"]["dirty"]]
    revisions = {bench.environment["git"]["revision"] for bench in benches}
    machines = dict.fromkeys(bench.machine for bench in benches)
    rows = [
        ["Artifact available", "yes", "source, results and the report's generator in one repository, Apache-2.0; CITATION.cff"],
        ["Identifier of the version", "yes", "git revision in every result; not archived with a DOI"],
        ["Hardware described", "yes", "; ".join(machines) or "no result yet"],
        ["Software described", "yes", "compilers, flags, drivers and system of each result: Appendix F"],
        ["Dependencies pinned", "partly", "Python packages by version; Debian packages by release; make bundle includes the rest"],
        ["Input data included", "yes", "paramsBulb.dat, paramsBox.dat, seeds in every file"],
        ["Set-up automated", "yes", "make demo, make test: one command each on a bare system"],
        ["Running time stated", "yes", "make help, for each target"],
        ["Correctness checked", "yes", "each picture before it is timed; make test; make equivalence"],
        ["Raw data included", "yes", f"{len(benches)} result files with every sample, in a published schema"],
        ["Analysis included", "yes", "make report: the same files give the same bytes; a test traces the front page's numbers to the files"],
        ["Variation reported", "yes", "intervals over runs if a file has several, otherwise over the samples of its run"],
        ["Results of one version", "no" if len(revisions) > 1 else "yes", f"{len(revisions)} revisions"
         + (f"; with uncommitted changes: {', '.join(dirty)}" if dirty else "")],
        ["Exact reproduction", "yes", "pictures in exact mode: the same bits on every machine; times: on the same machine, within their intervals"],
        ["Reproduced by others", "no", "no measurements from outside the project yet"],
    ]
    return {"checklist": Table(["criterion", "met", "where"], rows, "Checklist for reproducible artifacts, after the criteria of artifact evaluation (ACM, version 1.1).")}
