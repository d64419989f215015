package io.troupe.demo.verify;

import java.util.List;

/**
 * A statement of the paper and our result.
 *
 * @param section section of the paper
 * @param claim the paper's statement, abridged
 * @param ours our result
 * @param holds whether our result confirms the statement
 * @param details supporting lines, for example a trace in words
 */
record Statement(String section, String claim, String ours, boolean holds, List<String> details) {
    Statement {
        details = List.copyOf(details);
    }
}
