package io.troupe.demo.verify;

import java.util.List;

/**
 * A statement of the paper, and what we find.
 *
 * @param section where the paper says it
 * @param claim what it says, in short
 * @param ours our result
 * @param holds whether it is the same
 * @param details lines that show it, for example a trace in words
 */
record Statement(String section, String claim, String ours, boolean holds, List<String> details) {
    Statement {
        details = List.copyOf(details);
    }
}
