package io.troupe.checks.house;

import com.sun.source.tree.CompilationUnitTree;
import com.sun.source.tree.MethodTree;
import com.sun.source.util.JavacTask;
import com.sun.source.util.SourcePositions;
import com.sun.source.util.TreePathScanner;
import com.sun.source.util.Trees;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Collection;
import java.util.Comparator;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Objects;
import java.util.Set;
import java.util.function.BiPredicate;
import java.util.regex.Pattern;
import java.util.stream.Collectors;
import javax.tools.ToolProvider;

/**
 * Finds the test methods of one tree of Java sources in a later one, and their share of its test code.
 *
 * <p>A method is the same if it has the same name, or if at least {@value #ALIKE_PERCENT} per cent of the words of both
 * are common. The names are compared first, then the words; each method is found once at most. It runs without a build:
 *
 * <pre>java KeptTests.java BEFORE NOW [--places]</pre>
 */
final class KeptTests {
    static final int ALIKE_PERCENT = 40;

    /** As in {@code HouseFigures}; here too, because each of the two runs as a single source file. */
    private static final Set<String> TEST_ANNOTATIONS =
            Set.of("Test", "ParameterizedTest", "RepeatedTest", "TestFactory", "TestTemplate", "Property", "Example");

    private static final Pattern WORD = Pattern.compile("\\w{3,}");

    /** @param lines from its annotations to its last brace */
    record TestMethod(Path file, String name, Set<String> words, int lines) {
        private boolean isInFileOf(TestMethod other) {
            return file.getFileName().equals(other.file.getFileName());
        }

        private double likeness(TestMethod other) {
            long common = words.stream().filter(other.words::contains).count();
            return common / (double) Math.max(1, words.size() + other.words.size() - common);
        }
    }

    /** The test methods of a tree, and the lines of its test code, with those that are in no test method. */
    record TestCode(List<TestMethod> methods, long lines) {
        private long linesOfMethods(Collection<TestMethod> some) {
            return some.stream().mapToLong(TestMethod::lines).sum();
        }
    }

    private KeptTests() {}

    public static void main(String[] arguments) throws IOException {
        List<String> folders = new ArrayList<>(List.of(arguments));
        boolean places = folders.remove("--places");
        if (folders.size() != 2) {
            throw new IllegalArgumentException("folders are " + folders + ", expected BEFORE NOW");
        }
        TestCode before = read(Path.of(folders.getFirst()).toRealPath());
        TestCode now = read(Path.of(folders.getLast()).toRealPath());
        Map<TestMethod, TestMethod> kept = kept(before.methods(), now.methods());
        long ofKept = now.linesOfMethods(kept.values());
        double share = ofKept / (double) now.linesOfMethods(now.methods());
        System.out.printf(
                Locale.ROOT,
                "before: %,d test methods, %,d lines of test code%n"
                        + "now: %,d test methods, %,d lines of test code%n"
                        + "%,d of the methods before are among those now; these have %.0f %% of the lines of all%n"
                        + "test methods, which is %,d lines of test code with their share of what tests use in common%n",
                before.methods().size(),
                before.lines(),
                now.methods().size(),
                now.lines(),
                kept.size(),
                100 * share,
                Math.round(share * now.lines()));
        if (places) {
            before.methods().stream()
                    .filter(each -> !kept.containsKey(each))
                    .forEach(each -> System.out.println(each.file() + ": " + each.name() + " was not found"));
        }
    }

    /** For each method that was found again the one it is now. */
    static Map<TestMethod, TestMethod> kept(List<TestMethod> before, List<TestMethod> now) {
        Map<TestMethod, TestMethod> kept = new LinkedHashMap<>();
        Set<TestMethod> left = new LinkedHashSet<>(now);
        find(before, left, kept, (old, each) -> old.name().equals(each.name()));
        find(before, left, kept, (old, each) -> 100 * old.likeness(each) >= ALIKE_PERCENT);
        return kept;
    }

    private static void find(
            List<TestMethod> before,
            Set<TestMethod> left,
            Map<TestMethod, TestMethod> kept,
            BiPredicate<TestMethod, TestMethod> isSame) {
        for (TestMethod old : before) {
            if (!kept.containsKey(old)) {
                left.stream()
                        .filter(each -> isSame.test(old, each))
                        .max(Comparator.comparing(old::isInFileOf).thenComparing(old::likeness))
                        .ifPresent(found -> {
                            kept.put(old, found);
                            left.remove(found);
                        });
            }
        }
    }

    /** Reads every Java file below {@code src} folders of the modules in {@code root} that is no main code. */
    static TestCode read(Path root) throws IOException {
        List<Path> files;
        try (var walk = Files.walk(root)) {
            files = walk.filter(file -> root.relativize(file)
                            .toString()
                            .replace('\\', '/')
                            .matches("(?:docs/examples/)?(?:[^/]+/)?src/(?!main/).*\\.java"))
                    .sorted()
                    .toList();
        }
        if (files.isEmpty()) {
            throw new IllegalArgumentException("no test code in src folders of " + root + " or of its modules");
        }
        List<TestMethod> methods = new ArrayList<>();
        long lines = 0;
        var compiler = Objects.requireNonNull(ToolProvider.getSystemJavaCompiler(), "a JDK, not a JRE");
        try (var manager = compiler.getStandardFileManager(null, null, null)) {
            var objects = manager.getJavaFileObjectsFromPaths(files);
            var task = (JavacTask) compiler.getTask(null, manager, null, List.of("-proc:none"), null, objects);
            SourcePositions positions = Trees.instance(task).getSourcePositions();
            for (CompilationUnitTree unit : task.parse()) {
                Path file = Path.of(unit.getSourceFile().toUri());
                String text = Files.readString(file);
                lines += text.lines().count();
                methods.addAll(methods(root.relativize(file), text, unit, positions));
            }
        }
        return new TestCode(List.copyOf(methods), lines);
    }

    private static List<TestMethod> methods(
            Path file, String text, CompilationUnitTree unit, SourcePositions positions) {
        List<TestMethod> methods = new ArrayList<>();
        new TreePathScanner<Void, Void>() {
            @Override
            public Void visitMethod(MethodTree method, Void none) {
                boolean isTest = method.getModifiers().getAnnotations().stream()
                        .anyMatch(each -> TEST_ANNOTATIONS.contains(
                                each.getAnnotationType().toString().replaceFirst(".*\\.", "")));
                if (isTest) {
                    String code = text.substring((int) positions.getStartPosition(unit, method), (int)
                            positions.getEndPosition(unit, method));
                    Set<String> words = WORD.matcher(code)
                            .results()
                            .map(each -> each.group())
                            .collect(Collectors.toCollection(HashSet::new));
                    methods.add(new TestMethod(file, method.getName().toString(), words, (int)
                            code.lines().count()));
                }
                return super.visitMethod(method, none);
            }
        }.scan(unit, null);
        return methods;
    }
}
