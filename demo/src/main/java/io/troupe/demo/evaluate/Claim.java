package io.troupe.demo.evaluate;

import java.util.List;
import java.util.stream.Collectors;

/**
 * What the paper says, and what we find.
 *
 * @param source section and figure
 * @param words the paper's, or in brackets what it shows without saying it
 * @param measure in which kind of time, or what else was counted
 * @param criterion when we say that it holds
 * @param findings one for each number of cores
 */
record Claim(String source, String words, String measure, String criterion, List<Finding> findings) {
    /**
     * What we find in JVMs that were told a number of cores.
     *
     * @param ours the numbers
     */
    record Finding(int cores, String ours, Verdict verdict) {}

    Claim {
        findings = List.copyOf(findings);
    }

    Verdict verdict() {
        return Verdict.agreed(findings.stream().map(Finding::verdict).toList());
    }

    /** The numbers, once if they are the same for all numbers of cores. */
    String ours() {
        if (findings.stream().map(Finding::ours).distinct().count() == 1) {
            return findings.getFirst().ours();
        }
        return findings.stream()
                .map(each -> Findings.cores(each.cores()) + ": " + each.ours())
                .collect(Collectors.joining("; "));
    }
}
