package io.troupe.demo.evaluate;

import java.util.List;
import java.util.stream.Collectors;

/**
 * A claim of the paper, with our measured results.
 *
 * @param source section and figure of the paper
 * @param words quotation of the paper; in brackets if the paper only shows it
 * @param measure the kind of time, or what else was counted
 * @param criterion when the claim counts as confirmed
 * @param findings one for each number of cores
 */
record PaperClaim(String source, String words, String measure, String criterion, List<Finding> findings) {
    /**
     * The result for JVMs configured with one number of cores.
     *
     * @param ours the measured numbers, as text
     */
    record Finding(int cores, String ours, ClaimVerdict verdict) {}

    PaperClaim {
        findings = List.copyOf(findings);
    }

    ClaimVerdict verdict() {
        return ClaimVerdict.agreed(findings.stream().map(Finding::verdict).toList());
    }

    /** The measured numbers; printed once if they are equal for all numbers of cores. */
    String ours() {
        if (findings.stream().map(Finding::ours).distinct().count() == 1) {
            return findings.getFirst().ours();
        }
        return findings.stream()
                .map(each -> CoreMeasurements.cores(each.cores()) + ": " + each.ours())
                .collect(Collectors.joining("; "));
    }
}
