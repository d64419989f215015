package io.troupe.checks;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Set;
import java.util.TreeSet;
import java.util.regex.MatchResult;
import java.util.regex.Pattern;

/** The tests that a page names as {@code `ClassTest.method`}, and the tests that exist. */
public final class TestMethods {
    private static final Pattern REFERENCE = Pattern.compile("`(\\w+Test)\\.(\\w+)`");
    private static final Pattern TEST_METHOD =
            Pattern.compile("@(?:Test|Property|ParameterizedTest)\\b(?:(?!\\bvoid\\b)[\\s\\S])*?\\bvoid (\\w+)\\(");
    /** Quoted text, which may contain anything between the annotation and the method. */
    private static final Pattern STRING = Pattern.compile("\"(?:[^\"\\\\\\n]|\\\\.)*\"");

    /** A test method, with the simple name of its class. */
    public record Reference(String type, String method) {
        private static Reference of(MatchResult match) {
            return new Reference(match.group(1), match.group(2));
        }

        @Override
        public String toString() {
            return type + "." + method;
        }
    }

    private TestMethods() {}

    /** The tests that a text names. */
    public static List<Reference> namedIn(String text) {
        return REFERENCE.matcher(text).results().map(Reference::of).toList();
    }

    /** The tests that a text names and that do not exist. */
    public static Set<String> missing(String text) throws IOException {
        Set<String> missing = new TreeSet<>();
        for (Reference reference : namedIn(text)) {
            if (!of(reference.type()).contains(reference.method())) {
                missing.add(reference.toString());
            }
        }
        return missing;
    }

    /** The test methods of all test classes of that simple name. */
    public static List<String> of(String type) throws IOException {
        List<String> methods = new ArrayList<>();
        for (Path module : Repository.modules()) {
            var folder = module.resolve("src/test");
            if (Files.isDirectory(folder)) {
                try (var files = Files.walk(folder)) {
                    for (Path file :
                            files.filter(each -> each.endsWith(type + ".java")).toList()) {
                        var source = STRING.matcher(Files.readString(file)).replaceAll("\"\"");
                        TEST_METHOD.matcher(source).results().forEach(match -> methods.add(match.group(1)));
                    }
                }
            }
        }
        return methods;
    }
}
