package io.troupe.checks.docs;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.regex.Pattern;

/**
 * The samples of a Markdown page, and whether a source holds them.
 *
 * <p><b>Role.</b> A sample is cut in pieces by empty lines, and each piece must occur in one and the same source. What the formatter decides, and what no
 * compiler reads, does not count: white space, {@code //} comments, {@code @Override}.
 */
final class Samples {
    private static final Pattern FENCE = Pattern.compile("(?ms)^```(\\w*)\\n(.*?)^```$");
    private static final Pattern COMMENT = Pattern.compile("(?m)(?<![:\"])//.*$");
    private static final Pattern SPACE = Pattern.compile("\\s+");
    private static final Pattern SPACE_BESIDE_A_SIGN = Pattern.compile(" (?=\\W)|(?<=\\W) ");

    private Samples() {}

    /** A fenced block. */
    record Sample(String page, int line, String language, String text) {
        List<String> pieces() {
            return language.equals("java")
                    ? List.of(text.strip().split("\\n\\s*\\n"))
                    : text.strip().lines().toList();
        }

        @Override
        public String toString() {
            return page + ":" + line;
        }
    }

    static List<Sample> of(String page, String markdown) {
        List<Sample> samples = new ArrayList<>();
        var fences = FENCE.matcher(markdown);
        while (fences.find()) {
            int line = (int) markdown.substring(0, fences.start()).lines().count() + 1;
            samples.add(new Sample(page, line, fences.group(1), fences.group(2)));
        }
        return samples;
    }

    /** The text without what does not count. */
    static String essence(String java) {
        String code = COMMENT.matcher(java).replaceAll("").replace("@Override", "");
        String spaced = SPACE.matcher(code).replaceAll(" ").strip();
        return SPACE_BESIDE_A_SIGN.matcher(spaced).replaceAll("");
    }

    /**
     * What is wrong with a sample: nothing if one of the sources holds it.
     *
     * @param sources essences by path
     */
    static Set<String> missing(Sample sample, Map<String, String> sources) {
        var missingOf = new TreeMap<Integer, Set<String>>(); // by how many pieces are missing
        for (String essence : sources.values()) {
            var missing = sample.pieces().stream()
                    .filter(piece -> !essence.contains(essence(piece)))
                    .collect(java.util.stream.Collectors.toSet());
            missingOf.putIfAbsent(missing.size(), missing);
        }
        return missingOf.isEmpty()
                ? Set.copyOf(sample.pieces())
                : missingOf.firstEntry().getValue();
    }
}
