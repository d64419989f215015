package io.troupe.checks.docs;

import static java.util.stream.Collectors.toSet;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Map;
import java.util.Set;
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
        int end = start;
        for (int depth = 1; depth > 0; end++) {
            depth += java.charAt(end) == '{' ? 1 : java.charAt(end) == '}' ? -1 : 0;
        }
        return end - 1;
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
        return sources.values().stream()
                .map(essence -> sample.pieces().stream()
                        .filter(piece -> !essence.contains(essence(piece)))
                        .collect(toSet()))
                .min(Comparator.comparingInt(Set::size))
                .orElse(Set.copyOf(sample.pieces()));
    }
}
