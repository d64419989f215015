package io.troupe.checks.house;

import com.sun.source.tree.ClassTree;
import com.sun.source.tree.CompilationUnitTree;
import com.sun.source.tree.MethodTree;
import com.sun.source.util.JavacTask;
import com.sun.source.util.SourcePositions;
import com.sun.source.util.TreeScanner;
import com.sun.source.util.Trees;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Collection;
import java.util.HashMap;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Objects;
import java.util.Set;
import java.util.TreeMap;
import java.util.TreeSet;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.function.Predicate;
import java.util.function.ToIntFunction;
import java.util.regex.Pattern;
import java.util.stream.Collectors;
import java.util.stream.IntStream;
import java.util.stream.Stream;
import javax.lang.model.element.Modifier;
import javax.tools.ToolProvider;

/**
 * Measures trees of Java sources: files and lines, public types, types with one user, names that exist twice, comment
 * lines over 120 columns, how often comments avoid the technical noun, and tests.
 *
 * <p>Needs nothing but a JDK of release 21 or later, so that it can be run on any checkout, of this project or another.
 * It prints Markdown: a table with a column for each folder, and a table of the modules of each folder.
 * {@code --places} lists what was counted:
 *
 * <pre>{@code
 * java checks/src/test/java/io/troupe/checks/house/HouseFigures.java [FOLDER ..] [--places]
 * }</pre>
 */
final class HouseFigures {
    static final int COMMENT_COLUMNS = 120;
    static final int PROSE_COLUMNS = 100;

    /**
     * Words by which a comment avoids the noun that a reader would search for: caller, subscriber, listener, notify,
     * publish, reject, queue, thread. Each with a better one in the check's message.
     */
    static final Map<Pattern, String> HOUSE_WORDS = houseWords();

    /** A method of main code is shorter. */
    static final int METHOD_LINES = 60;

    /** Annotations of JUnit and jqwik that make a method a test, by their simple names. */
    private static final Set<String> TEST_ANNOTATIONS =
            Set.of("Test", "ParameterizedTest", "RepeatedTest", "TestFactory", "TestTemplate", "Property", "Example");

    private final List<SourceFile> main;
    private final List<SourceFile> test;

    HouseFigures(List<SourceFile> sources) {
        main = sources.stream().filter(SourceFile::isMain).toList();
        test = sources.stream().filter(each -> !each.isMain()).toList();
    }

    public static void main(String[] args) throws IOException {
        List<String> folders = new ArrayList<>(List.of(args));
        boolean places = folders.remove("--places");
        if (folders.isEmpty()) {
            folders.add(".");
        }
        List<HouseFigures> trees = new ArrayList<>();
        for (String folder : folders) {
            trees.add(new HouseFigures(read(Path.of(folder).toRealPath())));
        }
        var figures = trees.stream().map(HouseFigures::figures).toList();
        System.out.println(row("figure", folders));
        System.out.println("|---|" + "--:|".repeat(folders.size()));
        for (String name : figures.getFirst().keySet()) {
            System.out.println(
                    row(name, figures.stream().map(each -> each.get(name)).toList()));
        }
        for (int i = 0; i < trees.size(); i++) {
            System.out.println("\n" + folders.get(i) + "\n");
            trees.get(i).modules().forEach(System.out::println);
            if (places) {
                System.out.println();
                trees.get(i).places().forEach(System.out::println);
            }
        }
    }

    private static String row(String name, List<String> cells) {
        return "| " + name + " | " + String.join(" | ", cells) + " |";
    }

    /** Reads every Java file below {@code src} folders of the modules in {@code root}. */
    static List<SourceFile> read(Path root) throws IOException {
        List<Path> files;
        try (var walk = Files.walk(root)) {
            files = walk.filter(file -> file.toString().endsWith(".java"))
                    .filter(file -> root.relativize(file)
                            .toString()
                            .matches("(?:docs[/\\\\]examples[/\\\\])?(?:[^/\\\\]+[/\\\\])?src[/\\\\].*"))
                    .sorted()
                    .toList();
        }
        if (files.isEmpty()) {
            throw new IllegalArgumentException("no Java files in src folders of " + root + " or of its modules");
        }
        return SourceFile.read(root, files);
    }

    // ---- figures

    /** Top-level types that are not public and whose name one other file of the package mentions. */
    Map<String, String> typesWithOneUser() {
        Map<String, List<SourceFile>> byFolder =
                main.stream().collect(Collectors.groupingBy(each -> each.module() + ":" + each.packageName()));
        Map<String, String> found = new TreeMap<>();
        for (SourceFile file : main) {
            for (TopLevelType type : file.types()) {
                if (type.isPublic()) {
                    continue;
                }
                var users = byFolder.get(file.module() + ":" + file.packageName()).stream()
                        .filter(each -> each != file && each.names().contains(type.name()))
                        .toList();
                boolean usedAtHome =
                        file.types().size() > 1 && !file.types().getFirst().equals(type);
                if (users.size() == 1 && !usedAtHome) {
                    found.put(
                            file.packageName() + "." + type.name(),
                            users.getFirst().path().getFileName().toString());
                }
            }
        }
        return found;
    }

    /** Simple names of main code that several top-level types have, each with the packages of those types. */
    Map<String, Set<String>> namesThatExistTwice() {
        Map<String, Set<String>> packages = new TreeMap<>();
        for (SourceFile file : main) {
            for (TopLevelType type : file.types()) {
                packages.computeIfAbsent(type.name(), name -> new TreeSet<>()).add(file.packageName());
            }
        }
        packages.values().removeIf(each -> each.size() < 2);
        return packages;
    }

    /** Places of comment lines that are longer than {@link #COMMENT_COLUMNS}. */
    static List<String> longCommentLines(Collection<SourceFile> sources) {
        List<String> places = new ArrayList<>();
        for (SourceFile file : sources) {
            for (Comment comment : file.comments()) {
                comment.linesOver(COMMENT_COLUMNS).forEach(line -> places.add(file.path() + ":" + line));
            }
        }
        return places;
    }

    /** Places of methods of main code that have {@value #METHOD_LINES} lines or more. */
    static List<String> longMethods(Collection<SourceFile> sources) {
        return sources.stream()
                .filter(SourceFile::isMain)
                .flatMap(file -> file.longMethods().stream().map(method -> file.path() + method))
                .toList();
    }

    /** Places of comments of main code whose last line is a word or two: a formatter has broken the line before. */
    static List<String> brokenComments(Collection<SourceFile> sources) {
        List<String> places = new ArrayList<>();
        for (SourceFile file : sources.stream().filter(SourceFile::isMain).toList()) {
            Comment before = null;
            for (Comment comment : file.comments()) {
                boolean continues = before != null
                        && comment.text().startsWith("//")
                        && before.text().startsWith("//")
                        && comment.firstLine() == before.firstLine() + 1
                        && before.text().length() > 60;
                if (continues && comment.text().substring(2).strip().split(" ").length <= 2) {
                    places.add(file.path() + ":" + comment.firstLine() + " " + comment.text());
                }
                before = comment;
            }
        }
        return places;
    }

    /** Places of house words in comments, and in texts of main code, each with the word and a better one. */
    static List<String> houseWordsIn(Collection<SourceFile> sources) {
        List<String> places = new ArrayList<>();
        for (SourceFile file : sources) {
            file.comments().forEach(comment -> addHouseWords(places, file, comment.firstLine(), comment.words()));
            if (file.isMain()) { // those of tests are also the data of samples
                file.texts().forEach(text -> addHouseWords(places, file, text.firstLine(), text.words()));
            }
        }
        return places;
    }

    private static void addHouseWords(List<String> places, SourceFile file, int line, String words) {
        HOUSE_WORDS.forEach((pattern, better) -> pattern.matcher(words)
                .results()
                .forEach(hit -> places.add(file.path() + ":" + line + ": \"" + hit.group() + "\", better: " + better)));
    }

    // ---- Markdown

    /**
     * What is wrong in the prose of a Markdown page: a paragraph that is broken although a line of it is longer than
     * {@link #PROSE_COLUMNS}, and house words. Code and tables are left out, but words in tables are read.
     */
    static List<String> markdownProblems(String page, String text) {
        List<String> problems = new ArrayList<>();
        boolean code = false;
        String open = "";
        int number = 0;
        for (String line : text.lines().toList()) {
            number++;
            if (line.strip().startsWith("```")) {
                code = !code;
                open = "";
                continue;
            }
            if (code || open.isEmpty() && line.startsWith("    ")) {
                continue;
            }
            boolean begins = line.isBlank() || line.matches("\\s*(?:[-*+] |\\d+\\. |#|\\||>|<|!\\[).*");
            if (!begins && open.length() > PROSE_COLUMNS) {
                problems.add(page + ":" + number + ": a broken paragraph with a line of " + open.length() + " columns");
            }
            open = line.isBlank() || line.matches("\\s*(?:#|\\||<|!\\[).*") ? "" : line;
            String words = line.replaceAll("`[^`]*`|\\]\\([^)]*\\)", " ");
            int at = number;
            HOUSE_WORDS.forEach((pattern, better) -> pattern.matcher(words)
                    .results()
                    .forEach(hit -> problems.add(page + ":" + at + ": \"" + hit.group() + "\", better: " + better)));
        }
        return problems;
    }

    // ---- the report

    /** The figures of the whole tree by their names, in the order of the report. */
    Map<String, String> figures() {
        Map<String, String> figures = new LinkedHashMap<>();
        int[] lines = main.stream().mapToInt(SourceFile::lines).sorted().toArray();
        figures.put("main files", number(lines.length));
        figures.put("lines of them", number(sum(main, SourceFile::lines)));
        figures.put("lines with code, neither blank nor comment alone", number(sum(main, SourceFile::codeLines)));
        figures.put(
                "lines of a file: median, 90th percentile, largest",
                lines.length == 0
                        ? "-"
                        : number(lines[lines.length / 2])
                                + ", "
                                + number(lines[lines.length * 9 / 10])
                                + ", "
                                + number(lines[lines.length - 1]));
        figures.put("public types", number(publicTypes(main)));
        figures.put("public types in packages called `internal`", number(publicTypes(internal(main))));
        figures.put("types with one user", number(typesWithOneUser().size()));
        figures.put("names that exist twice", number(namesThatExistTwice().size()));
        figures.put(
                "comment lines over " + COMMENT_COLUMNS + " columns: main, test",
                number(longCommentLines(main).size()) + ", "
                        + number(longCommentLines(test).size()));
        figures.put("words of comments: main, test", number(words(main)) + ", " + number(words(test)));
        figures.put(
                "house words per 1,000 words of comments: main, test",
                houseWordRate(main) + ", " + houseWordRate(test));
        figures.put("test files", number(test.size()));
        figures.put("lines of test code", number(sum(test, SourceFile::lines)));
        figures.put("test methods", number(sum(test, SourceFile::testMethods)));
        return figures;
    }

    /** A table with a line for each module. */
    List<String> modules() {
        Map<String, List<SourceFile>> byModule = Stream.concat(main.stream(), test.stream())
                .collect(Collectors.groupingBy(SourceFile::module, TreeMap::new, Collectors.toList()));
        List<String> rows = new ArrayList<>();
        rows.add("| module | main files | lines | median | public types | of them internal | test files | lines "
                + "| test methods |");
        rows.add("|---|" + "--:|".repeat(8));
        byModule.forEach((module, files) -> {
            var mains = files.stream().filter(SourceFile::isMain).toList();
            var tests = files.stream().filter(each -> !each.isMain()).toList();
            int[] lines = mains.stream().mapToInt(SourceFile::lines).sorted().toArray();
            rows.add(row(
                    module,
                    List.of(
                            number(mains.size()),
                            number(sum(mains, SourceFile::lines)),
                            number(lines.length == 0 ? 0 : lines[lines.length / 2]),
                            number(publicTypes(mains)),
                            number(publicTypes(internal(mains))),
                            number(tests.size()),
                            number(sum(tests, SourceFile::lines)),
                            number(sum(tests, SourceFile::testMethods)))));
        });
        return rows;
    }

    /** Where each thing is that the figures count. */
    private List<String> places() {
        List<String> places = new ArrayList<>();
        for (var sources : List.of(main, test)) {
            longCommentLines(sources).forEach(each -> places.add(each + ": long comment line"));
            places.addAll(houseWordsIn(sources));
        }
        typesWithOneUser().forEach((type, user) -> places.add(type + " is used by " + user));
        namesThatExistTwice().forEach((name, where) -> places.add(name + " is in " + where));
        return places;
    }

    private static List<SourceFile> internal(Collection<SourceFile> files) {
        return files.stream()
                .filter(each -> List.of(each.packageName().split("\\.")).contains("internal"))
                .toList();
    }

    private static long publicTypes(Collection<SourceFile> files) {
        return files.stream()
                .flatMap(each -> each.types().stream())
                .filter(TopLevelType::isPublic)
                .count();
    }

    private static long words(Collection<SourceFile> files) {
        return files.stream()
                .flatMap(each -> each.comments().stream())
                .mapToLong(each -> each.words().split("\\s+").length)
                .sum();
    }

    private static String houseWordRate(Collection<SourceFile> files) {
        long words = words(files);
        return String.format(
                Locale.ROOT,
                "%.2f",
                words == 0 ? 0 : 1000.0 * houseWordsIn(files).size() / words);
    }

    private static String number(long value) {
        return String.format(Locale.ROOT, "%,d", value);
    }

    private static int sum(Collection<SourceFile> files, ToIntFunction<SourceFile> figure) {
        return files.stream().mapToInt(figure).sum();
    }

    private static Map<Pattern, String> houseWords() {
        Map<String, String> words = new HashMap<>();
        words.put("who(?:m|so)?ever", "caller, subscriber, client");
        words.put("(?:some|any|every)body|nobody", "caller, subscriber, client, listener, thread");
        words.put("no ?one", "no caller, no subscriber");
        words.put("hears?|heard|hearing", "receives, is notified, subscription");
        words.put("says|say|said", "specifies, reports, names, prints");
        words.put("(?:is|are|was|were|(?<!cannot )be|been|being) told", "is notified, receives");
        words.put("tells|told of", "notifies, reports, sends");
        words.put("(?:of|on) (?:its|his|their|our|your|her) own", "separate, private, dedicated; or leave it out");
        words.put("turn(?:s|ed|ing)? away", "reject");
        words.put("in vain", "without success");
        words.put("from aside|afresh|thereby|thereof|therein|hitherto", "a plain word");
        words.put("barks?|barked", "expires");
        words.put("mails?", "message");
        Map<Pattern, String> patterns = new HashMap<>();
        words.forEach((word, better) ->
                patterns.put(Pattern.compile("\\b(?:" + word + ")\\b", Pattern.CASE_INSENSITIVE), better));
        return Map.copyOf(patterns);
    }

    // ---- sources

    record TopLevelType(String name, boolean isPublic) {}

    /**
     * A comment with its delimiters.
     *
     * @param column of its first character, from 0
     */
    record Comment(int firstLine, int column, String text) {
        /** The numbers of those of its lines that end behind a column. */
        List<Integer> linesOver(int columns) {
            var lines = (" ".repeat(column) + text).lines().map(String::length).toList();
            return IntStream.range(0, lines.size())
                    .filter(i -> lines.get(i) > columns)
                    .mapToObj(i -> firstLine + i)
                    .toList();
        }

        /** The text without delimiters, tags and code. */
        String words() {
            return text.replaceAll("(?m)^\\s*(?:/\\*\\*?|\\*/?|//+)|\\*/", " ")
                    .replaceAll("(?s)<pre>.*?</pre>|\\{@(?:code|snippet|link|linkplain)[^}]*}", " ")
                    .strip();
        }
    }

    /** A text of the code, with its delimiters: a string or a text block. */
    record Literal(int firstLine, String text) {
        /** The text without its escapes; none if it has no blank, and so is a name or a keyword. */
        String words() {
            String words =
                    text.replaceAll("^\"+|\"+$", "").replaceAll("\\\\.", " ").strip();
            return words.contains(" ") ? words : "";
        }
    }

    /**
     * A source file.
     *
     * @param path relative to the folder that was read
     * @param codeLines lines with something else than comments
     * @param testMethods methods with an annotation of a test framework, in nested classes too
     * @param types top-level types in order
     * @param texts string literals and text blocks
     * @param names every identifier in its code, imports left out
     */
    record SourceFile(
            Path path,
            String packageName,
            int lines,
            int codeLines,
            int testMethods,
            List<TopLevelType> types,
            List<Comment> comments,
            List<Literal> texts,
            Set<String> names,
            List<String> longMethods) {
        private static final Pattern IDENTIFIER = Pattern.compile("[\\p{L}_$][\\p{L}\\p{N}_$]*");
        private static final Pattern IMPORT = Pattern.compile("(?m)^\\s*import\\s[^;]*;");

        String module() {
            return path.getName(0).toString();
        }

        boolean isMain() {
            return Stream.of("src/main/", "src\\main\\").anyMatch(path.toString()::contains);
        }

        /** Reads all files with the compiler's own parser; no name is resolved. */
        static List<SourceFile> read(Path root, Collection<Path> files) throws IOException {
            var compiler = Objects.requireNonNull(ToolProvider.getSystemJavaCompiler(), "a JDK, not a JRE");
            List<SourceFile> sources = new ArrayList<>();
            try (var manager = compiler.getStandardFileManager(null, null, null)) {
                var objects = manager.getJavaFileObjectsFromPaths(files);
                var task = (JavacTask) compiler.getTask(null, manager, null, List.of("-proc:none"), null, objects);
                var positions = Trees.instance(task).getSourcePositions();
                for (CompilationUnitTree unit : task.parse()) {
                    Path file = Path.of(unit.getSourceFile().toUri());
                    sources.add(of(root.relativize(file), Files.readString(file), unit, longMethods(unit, positions)));
                }
            }
            return sources;
        }

        /** The methods and constructors of {@value #METHOD_LINES} lines or more, with their first line and length. */
        private static List<String> longMethods(CompilationUnitTree unit, SourcePositions positions) {
            List<String> found = new ArrayList<>();
            new TreeScanner<Void, Void>() {
                @Override
                public Void visitMethod(MethodTree method, Void none) {
                    long first = unit.getLineMap().getLineNumber(positions.getStartPosition(unit, method));
                    long last = positions.getEndPosition(unit, method);
                    long lines = last < 0 ? 0 : unit.getLineMap().getLineNumber(last) - first + 1; // -1: not written
                    if (lines >= METHOD_LINES) {
                        found.add(":" + first + " " + method.getName() + " has " + lines + " lines");
                    }
                    return super.visitMethod(method, none);
                }
            }.scan(unit, null);
            return found;
        }

        private static SourceFile of(Path path, String text, CompilationUnitTree unit, List<String> longMethods) {
            List<Comment> comments = new ArrayList<>();
            List<Literal> texts = new ArrayList<>();
            String all = withoutComments(text, comments, texts);
            String code = IMPORT.matcher(all).replaceAll("");
            Set<String> names = new HashSet<>();
            IDENTIFIER.matcher(code).results().forEach(each -> names.add(each.group()));
            List<TopLevelType> types = new ArrayList<>();
            for (var declaration : unit.getTypeDecls()) {
                if (declaration instanceof ClassTree type) {
                    boolean isPublic = type.getModifiers().getFlags().contains(Modifier.PUBLIC);
                    types.add(new TopLevelType(type.getSimpleName().toString(), isPublic));
                }
            }
            String packageName = String.valueOf(unit.getPackageName());
            return new SourceFile(
                    path,
                    packageName,
                    (int) text.lines().count(),
                    (int) all.lines().filter(each -> !each.isBlank()).count(),
                    testMethods(unit),
                    types,
                    comments,
                    texts,
                    names,
                    longMethods);
        }

        private static int testMethods(CompilationUnitTree unit) {
            var count = new AtomicInteger();
            new TreeScanner<Void, AtomicInteger>() {
                @Override
                public Void visitMethod(MethodTree method, AtomicInteger tests) {
                    boolean isTest = method.getModifiers().getAnnotations().stream()
                            .anyMatch(each -> TEST_ANNOTATIONS.contains(
                                    each.getAnnotationType().toString().replaceFirst(".*\\.", "")));
                    tests.addAndGet(isTest ? 1 : 0);
                    return super.visitMethod(method, tests);
                }
            }.scan(unit, count);
            return count.get();
        }

        /** The code alone, each comment replaced by a space and each literal by an empty one on each of its lines. */
        static String withoutComments(String text, List<Comment> comments, List<Literal> texts) {
            Predicate<String> isComment = piece -> piece.startsWith("//") || piece.startsWith("/*");
            var code = new StringBuilder();
            int line = 1;
            int end;
            for (int i = 0; i < text.length(); i = end) {
                end = endOfPiece(text, i);
                String piece = text.substring(i, end);
                if (isComment.test(piece)) {
                    comments.add(new Comment(line, i - text.lastIndexOf('\n', i) - 1, piece));
                    code.append(' ');
                } else {
                    if (piece.length() > 1 && piece.startsWith("\"")) {
                        texts.add(new Literal(line, piece));
                    }
                    code.append(piece.length() == 1 ? piece : "\"\"" + "\n\"\"".repeat(lineEnds(piece)));
                }
                line += lineEnds(piece);
            }
            return code.toString();
        }

        private static int lineEnds(String piece) {
            return (int) piece.chars().filter(each -> each == '\n').count();
        }

        /** Where the comment, the literal or the character that begins at {@code start} ends. */
        private static int endOfPiece(String text, int start) {
            if (text.startsWith("//", start)) {
                int end = text.indexOf('\n', start);
                return end < 0 ? text.length() : end;
            }
            if (text.startsWith("/*", start)) {
                int end = text.indexOf("*/", start + 2);
                return end < 0 ? text.length() : end + 2;
            }
            if (text.startsWith("\"\"\"", start)) {
                return endOfLiteral(text, "\"\"\"", start + 3);
            }
            char first = text.charAt(start);
            return first == '"' || first == '\'' ? endOfLiteral(text, String.valueOf(first), start + 1) : start + 1;
        }

        private static int endOfLiteral(String text, String delimiter, int from) {
            for (int i = from; i < text.length(); i++) {
                if (text.charAt(i) == '\\') {
                    i++;
                } else if (text.startsWith(delimiter, i)) {
                    return i + delimiter.length();
                }
            }
            return text.length();
        }
    }
}
