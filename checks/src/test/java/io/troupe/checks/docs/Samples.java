package io.troupe.checks.docs;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.regex.Pattern;

/**
 * The samples of a Markdown page or of Javadoc, and their comparison with sources.
 *
 * <p><b>Role.</b> A sample is split at empty lines, and each piece must occur in one and the same source. The
 * comparison ignores what the formatter decides and what no compiler reads: white space, {@code //} comments,
 * {@code @Override}.
 */
final class Samples {
    private static final Pattern FENCE = Pattern.compile("(?ms)^```(\\w*)\\n(.*?)^```$");
    private static final Pattern COMMENT = Pattern.compile("(?m)(?<![:\"])//.*$");
    private static final Pattern JAVADOC = Pattern.compile("(?ms)^ */\\*\\*.*?\\*/");
    private static final Pattern SNIPPET = Pattern.compile("(?m)^ *\\* \\{@snippet :\\n");
    private static final Pattern STAR = Pattern.compile("(?m)^ *\\* ?");
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

    /** The Java samples in the Javadoc of a source: its inline {@code @snippet} tags, as they are printed. */
    static List<Sample> ofJavadoc(String source, String java) {
        List<Sample> samples = new ArrayList<>();
        var snippets = SNIPPET.matcher(java);
        while (snippets.find()) {
            int line = (int) java.substring(0, snippets.start()).lines().count() + 1;
            String code = java.substring(snippets.end(), endOfSnippet(java, snippets.end()));
            samples.add(new Sample(source, line, "java", STAR.matcher(code).replaceAll("")));
        }
        return samples;
    }

    /** The index of the brace that closes an inline tag, whose content has balanced braces. */
    private static int endOfSnippet(String java, int start) {
        int depth = 1;
        for (int end = start; end < java.length(); end++) {
            depth += java.charAt(end) == '{' ? 1 : java.charAt(end) == '}' ? -1 : 0;
            if (depth == 0) {
                return end;
            }
        }
        throw new IllegalArgumentException("a snippet without an end: " + java.substring(start));
    }

    /** The text without what the comparison ignores. */
    static String essence(String java) {
        String code = COMMENT.matcher(JAVADOC.matcher(java).replaceAll(""))
                .replaceAll("")
                .replace("@Override", "");
        String spaced = SPACE.matcher(code).replaceAll(" ").strip();
        return SPACE_BESIDE_A_SIGN.matcher(spaced).replaceAll("");
    }

    /**
     * The errors of a sample: empty if one of the sources contains it.
     *
     * @param sources essences by path
     */
    static Set<String> missing(Sample sample, Map<String, String> sources) {
        var missingOf = new TreeMap<Integer, Set<String>>(); // by the number of missing pieces
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
