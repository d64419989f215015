package io.troupe.demo;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.io.PrintWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Set;
import java.util.regex.Pattern;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import picocli.CommandLine;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.ParameterException;

/**
 * The commands of the documentation exist: those of troupe with their options, tasks of Gradle, modules and executions
 * of Maven, and the files of this repository that they name. Nothing is run.
 */
class DocumentedCommandsTest extends CommandLineBench {
    private static final Path ROOT = Path.of("").toAbsolutePath().getParent();
    private static final Pattern COMMAND = Pattern.compile(
            "`((?:\\./)?(?:troupe|gradlew|gradle|mvn) [^`]*)`|(?m)^ {0,4}((?:\\./troupe|\\./gradlew|mvn) .*)$");
    private static final Pattern WORD = Pattern.compile("(?:[^\\s\"']|\"[^\"]*\"|'[^']*')+");
    private static final Pattern TASK = Pattern.compile("register<\\w+>\\(\"(\\w+)\"\\)");
    private static final Pattern PLACEHOLDER =
            Pattern.compile("\\.{2,}|…|\\[.*|.*[|\\]].*|(?:nats://)?[A-Z]+[A-Z/]*(?:[:.]\\w+)?");
    private static final Set<String> TASKS_OF_EVERY_MODULE =
            Set.of("check", "test", "build", "clean", "publishToMavenLocal");
    private static final Set<String> WITH_VALUE = Set.of("--tests", "--args", "-p");

    private static List<Path> pages() throws IOException {
        List<Path> pages = new ArrayList<>(List.of(ROOT.resolve("README.md"), ROOT.resolve("CONTRIBUTING.md")));
        try (Stream<Path> files = Files.walk(ROOT.resolve("docs"))) {
            files.filter(file -> file.toString().endsWith(".md")).sorted().forEach(pages::add);
        }
        return pages;
    }

    @Test
    void commandsOfAllPages_exist() throws IOException {
        var commands = new LinkedHashSet<String>();
        List<String> problems = new ArrayList<>();
        for (Path page : pages()) {
            for (String command : commands(Files.readString(page))) {
                commands.add(command);
                problem(command)
                        .lines()
                        .forEach(problem -> problems.add(ROOT.relativize(page) + ": " + command + ": " + problem));
            }
        }
        assertThat(commands).hasSizeGreaterThan(100);
        assertThat(problems).isEmpty();
    }

    @Test
    void commandThatDoesNotExist_isFound() throws IOException {
        assertThat(commands("`./troupe run --seed 1` and\n\n    ./troupe draw x # why\n\n`troupe`, `gradle/x.toml`"))
                .containsExactly("./troupe run --seed 1", "./troupe draw x");
        assertThat(problem("./troupe run --sed 1")).contains("--sed");
        assertThat(problem("./troupe dance")).contains("dance");
        assertThat(problem("./troupe run --seed soon")).contains("soon");
        assertThat(problem("./troupe verify --nett FILE.pnml")).contains("--nett");
        assertThat(problem("./troupe draw demo/worlds/none.world")).contains("demo/worlds/none.world");
        assertThat(problem("./troupe verify --net")).contains("--net");
        assertThat(problem("troupe dance")).contains("dance");
        assertThat(problem("./gradlew figure8")).contains("figure8");
        assertThat(problem("./gradlew run --args=\"dance\"")).contains("dance");
        assertThat(problem("./gradlew :demo:dance")).contains("dance");
        assertThat(problem("./gradlew :demo:run --args=\"dance\"")).contains("dance");
        assertThat(problem("mvn compile exec:exec@figure8 -pl docs/examples/paper -am"))
                .contains("figure8");
        assertThat(problem("mvn test -pl nowhere")).contains("nowhere");
        assertThat(problem("mvn test -pl demo -Dtest='DanceTest'")).contains("DanceTest");
        assertThat(problem("./troupe serve --port 0 && ./troupe dance")).contains("dance");
        for (String right : List.of(
                "./troupe run --seed 1 --mode sync",
                "./troupe verify --net FILE.pnml",
                "./troupe --seed 1",
                "troupe verify --net",
                "./gradlew :paper:figure7",
                "./gradlew figure7",
                "./gradlew :demo:run --args=\"run --seconds 60\"",
                "mvn -B -ntp compile exec:exec@figure7 -pl docs/examples/paper -am -Dargs=\"--seconds 60\"")) {
            assertThat(problem(right)).isEmpty();
        }
    }

    @Test
    void errorsOnTheMapOfThePaper_arePrintedByItsCommands() throws IOException {
        String map = Files.readString(ROOT.resolve("docs/guide/19-map-of-the-paper.md"));
        String examples = "../docs/examples/paper/";
        assertThat(troupe("table " + examples + "both-follow-walls.table --out DIR"))
                .isEqualTo(Main.USAGE);
        assertThat(troupe("app --out DIR/o " + ARENA + examples + "missing-service.app"))
                .isEqualTo(Main.MISSING_SERVICE);
        assertThat(err.toString().replace("../docs", "docs").lines())
                .hasSize(4)
                .allSatisfy(line -> assertThat(map).contains("\n    " + line + "\n"));
    }

    private static List<String> commands(String markdown) {
        return COMMAND.matcher(markdown)
                .results()
                .map(each -> each.group(1) == null ? each.group(2) : each.group(1))
                .map(each -> each.replaceFirst("\\s+#.*", "").strip())
                .toList();
    }

    /** What is wrong with a command; empty if nothing is. */
    private static String problem(String line) throws IOException {
        var problems = new StringBuilder();
        for (String command : line.split(" && | ; | & |\\s+>")) {
            List<String> words = WORD.matcher(command)
                    .results()
                    .map(each -> each.group().replaceAll("[\"']", ""))
                    .toList();
            switch (words.isEmpty() ? "" : words.getFirst().replace("./", "")) {
                case "troupe" -> problems.append(ofTroupe(words.subList(1, words.size()), isMention(words)));
                case "gradlew", "gradle" -> problems.append(ofGradle(words.subList(1, words.size())));
                case "mvn" -> problems.append(ofMaven(words.subList(1, words.size())));
                default -> {}
            }
        }
        return problems.toString();
    }

    // ---- troupe

    /** Without a path it is the name of a command in a sentence, which may lack arguments. */
    private static boolean isMention(List<String> words) {
        return words.getFirst().equals("troupe");
    }

    private static String ofTroupe(List<String> words, boolean isMention) {
        for (String word : words) {
            if (word.matches("(?:demo|docs)/.*") && !Files.exists(ROOT.resolve(word))) {
                return "there is no file " + word + "\n";
            }
        }
        var nowhere = new PrintWriter(PrintWriter.nullWriter());
        CommandLine troupe = Main.commandLine(nowhere, nowhere);
        String[] arguments = Main.withCommand(words.toArray(String[]::new));
        if (isMention
                || words.stream()
                        .anyMatch(word -> PLACEHOLDER
                                .matcher(word.replaceFirst("^--[\\w-]+=", ""))
                                .matches())) {
            return ofNames(troupe.getCommandSpec(), List.of(arguments));
        }
        try {
            troupe.parseArgs(arguments);
            return "";
        } catch (ParameterException wrong) {
            return wrong.getMessage().lines().findFirst().orElse("wrong") + "\n";
        }
    }

    /** Of a command with placeholders, only the names of commands and options. */
    private static String ofNames(CommandSpec spec, List<String> words) {
        CommandSpec command = spec;
        boolean isCommand = true;
        for (String word : words) {
            String name = word.replaceFirst("^\\[", "").replaceFirst("[=\\]].*", "");
            if (name.startsWith("--")) {
                isCommand = false;
                if (!command.optionsMap().containsKey(name)) {
                    return command.qualifiedName() + " has no option " + name + "\n";
                }
            } else if (isCommand
                    && !command.subcommands().isEmpty()
                    && !PLACEHOLDER.matcher(word).matches()) {
                CommandLine next = command.subcommands().get(word);
                if (next == null) {
                    return command.qualifiedName() + " has no command " + word + "\n";
                }
                command = next.getCommandSpec();
            } else {
                isCommand = false;
            }
        }
        return "";
    }

    // ---- Gradle

    private static String ofGradle(List<String> words) throws IOException {
        String skipped = "";
        for (String word : words) {
            if (word.startsWith("--args=") && Set.of("run", ":demo:run").contains(words.getFirst())) {
                String problem =
                        ofTroupe(List.of(word.substring("--args=".length()).split(" ")), false);
                if (!problem.isEmpty()) {
                    return problem;
                }
            }
            boolean isTask = !word.startsWith("-")
                    && !WITH_VALUE.contains(skipped)
                    && !PLACEHOLDER.matcher(word).matches();
            skipped = word;
            if (isTask && !existsTask(word)) {
                return "there is no task " + word + "\n";
            }
        }
        return "";
    }

    private static boolean existsTask(String path) throws IOException {
        if (!path.startsWith(":")) {
            return TASKS_OF_EVERY_MODULE.contains(path) || tasks().contains(path) || existsTask(":demo:" + path);
        }
        String[] moduleAndTask = path.substring(1).split(":");
        Path script = script(moduleAndTask[0]);
        if (moduleAndTask.length != 2 || !Files.exists(script)) {
            return false;
        }
        String text = Files.readString(script);
        boolean isOfApplication = Set.of("run", "installDist").contains(moduleAndTask[1]);
        return TASKS_OF_EVERY_MODULE.contains(moduleAndTask[1])
                || isOfApplication && text.contains("plugins { application }")
                || TASK.matcher(text).results().anyMatch(each -> each.group(1).equals(moduleAndTask[1]));
    }

    private static Path script(String module) throws IOException {
        var folders = modules().stream().filter(folder -> ("/" + folder).endsWith("/" + module));
        return ROOT.resolve(folders.findFirst().orElse(module)).resolve("build.gradle.kts");
    }

    /** The tasks that the modules add, and which a name without a module selects. */
    private static Set<String> tasks() throws IOException {
        var tasks = new LinkedHashSet<String>();
        for (String module : modules()) {
            TASK.matcher(Files.readString(ROOT.resolve(module).resolve("build.gradle.kts")))
                    .results()
                    .forEach(each -> tasks.add(each.group(1)));
        }
        return tasks;
    }

    private static List<String> modules() throws IOException {
        return Pattern.compile("<module>([^<]+)</module>")
                .matcher(Files.readString(ROOT.resolve("pom.xml")))
                .results()
                .map(each -> each.group(1))
                .toList();
    }

    // ---- Maven

    private static String ofMaven(List<String> words) throws IOException {
        int option = words.indexOf("-pl");
        List<String> modules =
                option < 0 ? List.of() : List.of(words.get(option + 1).split(","));
        for (String module : modules) {
            if (!modules().contains(module)) {
                return "there is no module " + module + "\n";
            }
        }
        for (String word : words) {
            if (word.startsWith("exec:exec@")) {
                String id = word.substring("exec:exec@".length());
                String pom = Files.readString(ROOT.resolve(modules.getFirst()).resolve("pom.xml"));
                if (!pom.contains("<id>" + id + "</id>")) {
                    return modules.getFirst() + " has no execution " + id + "\n";
                }
            } else if (word.startsWith("-Dargs=") && modules.equals(List.of("demo"))) {
                return ofTroupe(List.of(word.substring("-Dargs=".length()).split(" ")), false);
            } else if (word.startsWith("-Dtest=") && !word.contains("*")) {
                for (String test : word.substring("-Dtest=".length()).split(",")) {
                    if (!existsTest(test.replaceFirst("#.*", ""), modules)) {
                        return "there is no test " + test + "\n";
                    }
                }
            }
        }
        return "";
    }

    private static boolean existsTest(String name, List<String> modules) throws IOException {
        for (String module : modules) {
            try (Stream<Path> files = Files.walk(ROOT.resolve(module).resolve("src/test"))) {
                if (files.anyMatch(file -> file.getFileName().toString().matches(name + "\\.(?:java|kt)"))) {
                    return true;
                }
            }
        }
        return false;
    }
}
