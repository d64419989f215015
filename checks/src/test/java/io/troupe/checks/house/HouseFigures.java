package io.troupe.checks.house;

import com.sun.source.tree.ClassTree;
import com.sun.source.tree.CompilationUnitTree;
import com.sun.source.util.JavacTask;
import java.io.IOException;
import java.io.PrintStream;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Collection;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Objects;
import java.util.Set;
import java.util.TreeMap;
import java.util.TreeSet;
import java.util.function.Predicate;
import java.util.regex.Pattern;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import javax.lang.model.element.Modifier;
import javax.tools.ToolProvider;

/**
 * Measures a tree of Java sources: files and lines, types with one user, names that exist twice, comment lines over 120
 * columns, and how often comments avoid the technical noun.
 *
 * <p>Needs nothing but a JDK of release 21 or later, so that it can be run on any checkout, of this project or another;
 * {@code --places} lists what was counted:
 *
 * <pre>{@code
 * java checks/src/test/java/io/troupe/checks/house/HouseFigures.java [FOLDER] [--places]
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

    private final List<SourceFile> main;
    private final List<SourceFile> test;

    HouseFigures(List<SourceFile> sources) {
        main = sources.stream().filter(SourceFile::isMain).toList();
        test = sources.stream().filter(each -> !each.isMain()).toList();
    }

    public static void main(String[] args) throws IOException {
        boolean places = List.of(args).contains("--places");
        var folder = Stream.of(args).filter(each -> !each.equals("--places")).findFirst();
        var sources = read(Path.of(folder.orElse(".")).toRealPath());
        var figures = new HouseFigures(sources);
        figures.print(System.out);
        if (places) {
            longCommentLines(sources).forEach(each -> System.out.println(each + ": long comment line"));
            houseWordsIn(sources).forEach(System.out::println);
            figures.typesWithOneUser().forEach((type, user) -> System.out.println(type + " is used by " + user));
            figures.namesThatExistTwice().forEach((name, where) -> System.out.println(name + " is in " + where));
        }
    }

    /** Reads every Java file below {@code src} folders of the modules in {@code root}. */
    static List<SourceFile> read(Path root) throws IOException {
        List<Path> files;
        try (var walk = Files.walk(root)) {
            files = walk.filter(file -> file.toString().endsWith(".java"))
                    .filter(file -> root.relativize(file).toString().matches("(?:[^/\\\\]+[/\\\\])?src[/\\\\].*"))
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
                if (comment.lastColumn() > COMMENT_COLUMNS) {
                    places.add(file.path() + ":" + comment.firstLine());
                }
            }
        }
        return places;
    }

    /** Places of house words in comments, each with the word and a better one. */
    static List<String> houseWordsIn(Collection<SourceFile> sources) {
        List<String> places = new ArrayList<>();
        for (SourceFile file : sources) {
            for (Comment comment : file.comments()) {
                HOUSE_WORDS.forEach((pattern, better) -> pattern.matcher(comment.words())
                        .results()
                        .forEach(hit -> places.add(file.path() + ":" + comment.firstLine() + ": \"" + hit.group()
                                + "\", better: " + better)));
            }
        }
        return places;
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

    private void print(PrintStream out) {
        var lines = main.stream().mapToInt(SourceFile::lines).sorted().toArray();
        out.printf(
                Locale.ROOT,
                "main files %d, lines %d, a file: median %d, 90th percentile %d, largest %d%n",
                lines.length,
                sum(main),
                lines[lines.length / 2],
                lines[lines.length * 9 / 10],
                lines[lines.length - 1]);
        out.printf(Locale.ROOT, "test files %d, lines %d%n", test.size(), sum(test));
        out.printf(Locale.ROOT, "types with one user %d%n", typesWithOneUser().size());
        var twice = namesThatExistTwice();
        out.printf(Locale.ROOT, "names that exist twice %d %s%n", twice.size(), twice.keySet());
        for (var sources : List.of(main, test)) {
            String name = sources == main ? "main" : "test";
            long words = sources.stream()
                    .flatMap(each -> each.comments().stream())
                    .mapToLong(each -> each.words().split("\\s+").length)
                    .sum();
            int hits = houseWordsIn(sources).size();
            out.printf(
                    Locale.ROOT,
                    "comments of %s code: %d words, %d lines over %d columns, house words %d, of 1,000 words %.2f%n",
                    name,
                    words,
                    longCommentLines(sources).size(),
                    COMMENT_COLUMNS,
                    hits,
                    words == 0 ? 0.0 : 1000.0 * hits / words);
        }
        out.println("module              main files   lines  median  public types");
        main.stream()
                .collect(Collectors.groupingBy(SourceFile::module, TreeMap::new, Collectors.toList()))
                .forEach((module, files) -> out.printf(
                        Locale.ROOT,
                        "%-19s %10d %7d %7d %13d%n",
                        module,
                        files.size(),
                        sum(files),
                        files.stream().mapToInt(SourceFile::lines).sorted().toArray()[files.size() / 2],
                        files.stream()
                                .flatMap(each -> each.types().stream())
                                .filter(TopLevelType::isPublic)
                                .count()));
    }

    private static int sum(Collection<SourceFile> files) {
        return files.stream().mapToInt(SourceFile::lines).sum();
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
     * @param lastColumn of its longest line
     */
    record Comment(int firstLine, int lastColumn, String text) {
        /** The text without delimiters, tags and code. */
        String words() {
            return text.replaceAll("(?m)^\\s*(?:/\\*\\*?|\\*/?|//+)|\\*/", " ")
                    .replaceAll("(?s)<pre>.*?</pre>|\\{@(?:code|snippet|link|linkplain)[^}]*}", " ")
                    .strip();
        }
    }

    /**
     * A source file.
     *
     * @param path relative to the folder that was read
     * @param types top-level types in order
     * @param names every identifier in its code, imports left out
     */
    record SourceFile(
            Path path,
            String packageName,
            int lines,
            List<TopLevelType> types,
            List<Comment> comments,
            Set<String> names) {
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
                for (CompilationUnitTree unit : task.parse()) {
                    Path file = Path.of(unit.getSourceFile().toUri());
                    sources.add(of(root.relativize(file), Files.readString(file), unit));
                }
            }
            return sources;
        }

        private static SourceFile of(Path path, String text, CompilationUnitTree unit) {
            List<Comment> comments = new ArrayList<>();
            String code = IMPORT.matcher(withoutComments(text, comments)).replaceAll("");
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
            return new SourceFile(path, packageName, (int) text.lines().count(), types, comments, names);
        }

        /** The code alone, each comment replaced by a space and each literal by an empty one. */
        static String withoutComments(String text, List<Comment> comments) {
            Predicate<String> isComment = piece -> piece.startsWith("//") || piece.startsWith("/*");
            var code = new StringBuilder();
            int line = 1;
            int end;
            for (int i = 0; i < text.length(); i = end) {
                end = endOfPiece(text, i);
                String piece = text.substring(i, end);
                if (isComment.test(piece)) {
                    int column = i - text.lastIndexOf('\n', i) - 1;
                    int longest = (" ".repeat(column) + piece)
                            .lines()
                            .mapToInt(String::length)
                            .max()
                            .orElse(0);
                    comments.add(new Comment(line, longest, piece));
                    code.append(' ');
                } else {
                    code.append(piece.length() == 1 ? piece : "\"\"");
                }
                line += (int) piece.chars().filter(each -> each == '\n').count();
            }
            return code.toString();
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
