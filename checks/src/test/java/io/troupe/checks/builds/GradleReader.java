package io.troupe.checks.builds;

import io.troupe.checks.builds.Build.Dependency;
import io.troupe.checks.builds.Build.Module;
import io.troupe.checks.builds.Build.NotUnderstood;
import io.troupe.checks.builds.Build.Scope;
import io.troupe.checks.builds.GradleReader.KotlinScript.Statement;
import java.io.IOException;
import java.io.StringReader;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.Set;
import java.util.SortedMap;
import java.util.TreeMap;
import java.util.TreeSet;
import java.util.regex.Pattern;

/**
 * The Gradle build, read from its scripts without running Gradle.
 *
 * <p><b>Errors.</b> It understands the few forms that our scripts use. Anything else is a {@link NotUnderstood}; so is
 * a skipped part that mentions a subject on which the two builds must agree.
 */
final class GradleReader {
    private static final Pattern QUOTED = Pattern.compile("\"([^\"]*)\"");
    private static final Pattern INCLUDE = Pattern.compile("include\\(\\s*(\"[\\w-]+\"\\s*,?\\s*)+\\)");
    private static final Pattern FOLDER =
            Pattern.compile("project\\(\":([\\w-]+)\"\\)\\.projectDir = file\\(\"([\\w/-]+)\"\\)");
    private static final Pattern PUBLISHED = Pattern.compile("val published = setOf\\((\\s*\"[\\w-]+\"\\s*,?)+\\)");
    private static final Pattern DESCRIPTION = Pattern.compile("description = \"([^\"]*)\"");
    private static final Pattern ON_MODULE = Pattern.compile("(\\w+)\\(project\\(\":([\\w-]+)\"\\)\\)");
    private static final Pattern ON_TESTS =
            Pattern.compile("(\\w+)\\(project\\(path = \":([\\w-]+)\", configuration = \"tests\"\\)\\)");
    private static final Pattern ON_LIBRARY = Pattern.compile("(\\w+)\\(libs\\.([\\w.]+)\\)");
    private static final Pattern EXCLUDE =
            Pattern.compile("exclude\\(group = \"([\\w.-]+)\", module = \"([\\w.-]+)\"\\)");
    private static final Pattern ON_LIBRARY_FOR_ALL =
            Pattern.compile("\"(\\w+)\"\\(libs\\.findLibrary\\(\"([\\w-]+)\"\\)\\.get\\(\\)\\)");
    private static final Pattern MANIFEST =
            Pattern.compile("\\s*manifest \\{ attributes\\(\"Automatic-Module-Name\" to \"([\\w.]+)\"\\) }\\s*");
    private static final Pattern PROGRAM = Pattern.compile("tasks\\.register<JavaExec>\\(\"(\\w+)\"\\)|(application)");
    private static final Pattern MAIN_CLASS = Pattern.compile("mainClass\\.set\\(\"([\\w.]+)\"\\)");
    private static final Pattern JVM_OPTION = Pattern.compile("jvmArgs\\(\"([^\"]+)\"\\)");
    private static final Pattern RELEASE = Pattern.compile("options\\.release\\.set\\((\\d+)\\)");
    private static final Pattern TELLING = Pattern.compile(
            "\\b(dependencies|libs|findLibrary|project\\s*\\(|release|exclude|constraints|configurations|resolutionStrategy|platform|include|maven\\s*[({]|url\\s*=)");
    private static final String CATALOG_IN_ROOT =
            "val libs = rootProject.extensions.getByType<VersionCatalogsExtension>().named(\"libs\")";
    /** The jar of a module's tests, for the tests of others, without white space. */
    private static final Map<String, String> TESTS_JAR = Map.of(
            "configurations.create(\"tests\")",
            "isCanBeResolved=false",
            "artifacts",
            "add(\"tests\",tasks.register<Jar>(\"testsJar\"){archiveClassifier.set(\"tests\")"
                    + "from(sourceSets.test.get().output)})");

    private static final String KOTLIN_PLUGIN = "alias(libs.plugins.kotlin.jvm)";
    private static final Pattern KOTLIN_OPTION = Pattern.compile("(\\w+)\\.(?:set|add)\\(\"?([^\"()]*)\"?\\)");
    private static final String JVM_TARGET = "org.jetbrains.kotlin.gradle.dsl.JvmTarget.JVM_";

    private static final String REPOSITORIES =
            "repositoriesMode.set(RepositoriesMode.FAIL_ON_PROJECT_REPOS) repositories { mavenCentral() }";

    private final Properties properties = new Properties();
    private final VersionCatalog catalog;
    private final List<Dependency> forAll = new ArrayList<>();
    private final Set<String> published = new TreeSet<>();
    private final Map<String, Module> modules = new LinkedHashMap<>();
    private String release = "";

    private GradleReader(Path root) throws IOException {
        properties.load(new StringReader(Files.readString(root.resolve("gradle.properties"))));
        catalog = new VersionCatalog(Files.readString(root.resolve("gradle/libs.versions.toml")));
        readRootScript(Files.readString(root.resolve("build.gradle.kts")));
        var folders = folders(Files.readString(root.resolve("settings.gradle.kts")));
        for (String name : folders.keySet()) {
            var file = folders.get(name) + "/build.gradle.kts";
            modules.put(name, readModule(file, published.contains(name), Files.readString(root.resolve(file))));
        }
    }

    static Build read(Path root) throws IOException {
        var reader = new GradleReader(root);
        var owner = new TreeMap<String, String>();
        for (String name : reader.properties.stringPropertyNames()) {
            if (name.startsWith(Build.OWNER)) {
                owner.put(name, reader.property(name));
            }
        }
        return new Build("Gradle", reader.property("group"), reader.property("version"), owner, reader.modules);
    }

    /** The libraries of the catalog that no script uses. */
    static Set<String> unusedLibraries(Path root) throws IOException {
        return new GradleReader(root).catalog.unused();
    }

    /** The folders of the modules by their names; by default a folder has the name of its module. */
    static Map<String, String> folders(String settings) {
        var file = "settings.gradle.kts";
        Map<String, String> folders = new LinkedHashMap<>();
        for (var statement : KotlinScript.statements(file, settings)) {
            if (INCLUDE.matcher(statement.head()).matches()) {
                QUOTED.matcher(statement.head()).results().forEach(name -> folders.put(name.group(1), name.group(1)));
            } else if (FOLDER.matcher(statement.head()).matches()) {
                var folder =
                        FOLDER.matcher(statement.head()).replaceAll("$1 $2").split(" ");
                NotUnderstood.unless(
                        folders.replace(folder[0], folder[1]) != null && folder[1].endsWith("/" + folder[0]),
                        file + ": expected an included module and a folder of its name, found " + statement.head());
            } else if (statement.head().equals("dependencyResolutionManagement")) {
                var body = statement.body().strip().replaceAll("\\s+", " ");
                NotUnderstood.unless(
                        body.equals(REPOSITORIES), file + ": expected " + REPOSITORIES + ", found " + body);
            } else if (statement.head().equals("pluginManagement")) {
                NotUnderstood.unless(
                        statement.body().strip().equals("repositories { mavenCentral() }"),
                        file + ": plugins are expected from Maven Central alone, found " + statement.body());
            } else if (!statement.head().equals("rootProject.name = \"troupe\"")) {
                throw notUnderstood(file, statement);
            }
        }
        return folders;
    }

    private void readRootScript(String script) {
        var file = "build.gradle.kts";
        for (var statement : KotlinScript.statements(file, script)) {
            if (statement.head().equals("subprojects")) {
                statement.inner(file).forEach(inner -> readShared(file, inner));
            } else if (PUBLISHED.matcher(statement.head()).matches()) {
                QUOTED.matcher(statement.head()).results().forEach(name -> published.add(name.group(1)));
            } else if (statement.head().matches("(?s)(?:val |fun |if \\().*")) {
                requireNothingTelling(file, statement);
            } else {
                throw notUnderstood(file, statement);
            }
        }
        NotUnderstood.unless(!release.isEmpty(), file + ": no options.release.set(..) for JavaCompile");
    }

    private void readShared(String file, Statement statement) {
        if (statement.head().equals("dependencies")) {
            for (var inner : statement.inner(file)) {
                var match = ON_LIBRARY_FOR_ALL.matcher(inner.head());
                if (!match.matches()) {
                    throw notUnderstood(file, inner);
                }
                addLibrary(forAll, match.group(1), match.group(2));
            }
        } else if (statement.head().equals("tasks.withType<JavaCompile>().configureEach")) {
            for (var inner : statement.inner(file)) {
                var match = RELEASE.matcher(inner.head());
                if (match.matches()) {
                    release = match.group(1);
                } else {
                    requireNothingTelling(file, inner);
                }
            }
        } else if (!statement.head().equals(CATALOG_IN_ROOT)) {
            requireNothingTelling(file, statement);
        }
    }

    private Module readModule(String file, boolean isPublished, String script) {
        var description = "";
        var automaticName = "";
        var kotlin = new TreeSet<String>();
        var programs = new TreeMap<String, String>();
        List<Dependency> dependencies = new ArrayList<>(forAll);
        for (var statement : KotlinScript.statements(file, script)) {
            var described = DESCRIPTION.matcher(statement.head());
            var named = MANIFEST.matcher(statement.body());
            if (described.matches()) {
                description = described.group(1);
            } else if (statement.head().equals("dependencies")) {
                statement.inner(file).forEach(inner -> dependencies.add(dependency(file, isPublished, inner)));
            } else if (statement.head().equals("tasks.jar") && named.matches()) {
                automaticName = named.group(1);
            } else if (statement.head().equals("plugins")
                    && statement.body().strip().equals(KOTLIN_PLUGIN)) {
                kotlin.add("compiler " + catalog.versionOf("kotlin"));
            } else if (statement.head().equals("kotlin")) {
                statement.inner(file).forEach(inner -> readKotlin(file, inner, kotlin));
            } else if (statement.head().equals("configurations.testImplementation")
                    && statement.body().strip().equals("extendsFrom(configurations.compileOnly.get())")) {
                continue; // as Maven's scope "provided"
            } else if (TESTS_JAR.containsKey(statement.head())) {
                NotUnderstood.unless(
                        statement.body().replaceAll("\\s", "").equals(TESTS_JAR.get(statement.head())),
                        file + ": " + statement.head() + " is not understood, expected the jar of the tests");
            } else if (statement.head().equals("plugins")
                    && !statement.body().strip().equals("application")) {
                throw notUnderstood(file, statement);
            } else if (statement.block()
                    && statement.head().matches("plugins|application|distributions\\.main|tasks\\b.*")) {
                requireNothingTelling(file, statement);
                readProgram(file, statement, programs);
            } else {
                throw notUnderstood(file, statement);
            }
        }
        return new Module(description, release, automaticName, kotlin, programs, dependencies);
    }

    /** A task that starts a program; the plugin {@code application} has one that is called {@code run}. */
    private static void readProgram(String file, Statement statement, SortedMap<String, String> programs) {
        var task = PROGRAM.matcher(statement.head());
        if (!task.matches()) {
            return;
        }
        var main = MAIN_CLASS.matcher(statement.body());
        NotUnderstood.unless(main.find(), file + ": no mainClass.set(\"..\") in: " + statement.head());
        var program = new StringBuilder();
        JVM_OPTION
                .matcher(statement.body())
                .results()
                .forEach(option -> program.append(option.group(1)).append(' '));
        programs.put(
                task.group(2) == null ? task.group(1) : "run",
                program.append(main.group(1)).toString());
    }

    private static void readKotlin(String file, Statement statement, Set<String> arguments) {
        if (statement.head().equals("explicitApi()")) {
            arguments.add("main -Xexplicit-api=strict");
            return;
        }
        if (!statement.head().equals("compilerOptions")) {
            throw notUnderstood(file, statement);
        }
        for (var option : statement.inner(file)) {
            var match = KOTLIN_OPTION.matcher(option.head());
            if (!match.matches()) {
                throw notUnderstood(file, option);
            }
            var value = match.group(2);
            arguments.add(
                    switch (match.group(1) + (value.equals("true") ? "" : " .")) {
                        case "jvmTarget ." -> "-jvm-target " + value.replace(JVM_TARGET, "");
                        case "allWarningsAsErrors" -> "-Werror";
                        case "javaParameters" -> "-java-parameters";
                        case "freeCompilerArgs ." -> value;
                        default -> throw notUnderstood(file, option);
                    });
        }
    }

    /** A dependency with the scope that it gets in the POM which Gradle publishes, if the module is published. */
    private Dependency dependency(String file, boolean isPublished, Statement statement) {
        var onModule = ON_MODULE.matcher(statement.head());
        if (!statement.block() && onModule.matches()) {
            var coordinates = property("group") + ":" + Module.artifact(onModule.group(2));
            return new Dependency(scope(isPublished, onModule.group(1)), coordinates, property("version"));
        }
        var onTests = ON_TESTS.matcher(statement.head());
        if (!statement.block() && onTests.matches()) {
            var coordinates = property("group") + ":" + Module.artifact(onTests.group(2)) + ":tests";
            return new Dependency(scope(isPublished, onTests.group(1)), coordinates, property("version"));
        }
        var onLibrary = ON_LIBRARY.matcher(statement.head());
        if (onLibrary.matches()) {
            return catalog.library(scope(isPublished, onLibrary.group(1)), onLibrary.group(2))
                    .excluding(excluded(file, statement));
        }
        throw notUnderstood(file, statement);
    }

    /** The transitive dependencies that the block after a library excludes. */
    private static List<String> excluded(String file, Statement statement) {
        List<String> excluded = new ArrayList<>();
        for (var inner : statement.inner(file)) {
            var match = EXCLUDE.matcher(inner.head());
            if (!match.matches()) {
                throw notUnderstood(file, inner);
            }
            excluded.add(match.group(1) + ":" + match.group(2));
        }
        return excluded;
    }

    /** Skips JUnit's launcher, which has no counterpart: Surefire adds its own. */
    private void addLibrary(List<Dependency> dependencies, String configuration, String alias) {
        var library = catalog.library(scope(configuration), alias);
        if (!library.coordinates().equals("org.junit.platform:junit-platform-launcher")) {
            dependencies.add(library);
        }
    }

    private static Scope scope(boolean isPublished, String configuration) {
        return isPublished && configuration.equals("implementation") ? Scope.RUNTIME : scope(configuration);
    }

    private static Scope scope(String configuration) {
        return switch (configuration) {
            case "api", "implementation" -> Scope.COMPILE;
            case "compileOnly" -> Scope.PROVIDED;
            case "runtimeOnly" -> Scope.RUNTIME;
            case "testImplementation", "testRuntimeOnly" -> Scope.TEST;
            case "annotationProcessor" -> Scope.PROCESSOR;
            default -> throw new NotUnderstood("configuration " + configuration + " is not understood");
        };
    }

    private String property(String name) {
        var value = properties.getProperty(name);
        if (value == null) {
            throw new NotUnderstood("gradle.properties: " + name + " is missing");
        }
        return value;
    }

    private static void requireNothingTelling(String file, Statement statement) {
        var telling = TELLING.matcher(statement.head() + " {" + statement.body());
        if (telling.find()) {
            throw new NotUnderstood(file + ": \"" + telling.group() + "\" is not understood in: " + statement.head());
        }
    }

    private static NotUnderstood notUnderstood(String file, Statement statement) {
        return new NotUnderstood(file + ": not understood: " + statement.head() + (statement.block() ? " {..}" : ""));
    }

    /** Reads {@code gradle/libs.versions.toml}; it understands versions, and libraries with module and version. */
    static final class VersionCatalog {
        private static final String FILE = "libs.versions.toml: ";
        private static final Pattern VERSION = Pattern.compile("([\\w-]+)\\s*=\\s*\"([^\"]+)\"");
        private static final Pattern LIBRARY = Pattern.compile(
                "([\\w-]+)\\s*=\\s*\\{\\s*module\\s*=\\s*\"([^\":]+:[^\":]+)\"\\s*,\\s*version\\.ref\\s*=\\s*\"([^\"]+)\"\\s*}");

        private final Map<String, String> versions = new LinkedHashMap<>();
        private final Map<String, Dependency> libraries = new LinkedHashMap<>();
        private final Set<String> used = new HashSet<>();

        VersionCatalog(String toml) {
            var section = "";
            for (String line : toml.lines().map(String::strip).toList()) {
                if (line.startsWith("[")) {
                    section = line;
                } else if (!line.isEmpty() && !line.startsWith("#")) {
                    switch (section) {
                        case "[versions]" -> version(line);
                        case "[libraries]" -> library(line);
                        case "[plugins]" -> plugin(line);
                        default -> throw new NotUnderstood(FILE + "section " + section + " is not understood");
                    }
                }
            }
        }

        /**
         * Reads one version. Gradle's "2.57!!" means exactly this version, which Maven assumes for every direct
         * dependency.
         */
        private void version(String line) {
            var match = VERSION.matcher(line);
            if (!match.matches() || versions.put(match.group(1), match.group(2).replaceFirst("!!$", "")) != null) {
                throw new NotUnderstood(FILE + "not understood, or given twice: " + line);
            }
        }

        private void library(String line) {
            var match = LIBRARY.matcher(line);
            NotUnderstood.unless(
                    match.matches(), FILE + "expected alias = { module = .., version.ref = .. }, found: " + line);
            var version = versions.get(match.group(3));
            if (version == null) {
                throw new NotUnderstood(FILE + "no version named " + match.group(3) + ", asked for by: " + line);
            }
            libraries.put(accessor(match.group(1)), new Dependency(Scope.COMPILE, match.group(2), version));
        }

        /** The plugins are those of Kotlin, with its version. */
        private static void plugin(String line) {
            NotUnderstood.unless(
                    line.equals("kotlin-jvm = { id = \"org.jetbrains.kotlin.jvm\", version.ref = \"kotlin\" }"),
                    FILE + "no other plugin than Kotlin's is understood: " + line);
        }

        String versionOf(String name) {
            return versions.getOrDefault(name, "");
        }

        /** The library that {@code libs.<accessor>} or an alias names, in the given scope. */
        Dependency library(Scope scope, String alias) {
            var library = libraries.get(accessor(alias));
            if (library == null) {
                throw new NotUnderstood(FILE + "no library " + alias + "; there are " + libraries.keySet());
            }
            used.add(accessor(alias));
            return new Dependency(scope, library.coordinates(), library.version());
        }

        /** The libraries that were not requested yet. */
        Set<String> unused() {
            var unused = new TreeSet<>(libraries.keySet());
            unused.removeAll(used);
            return unused;
        }

        private static String accessor(String alias) {
            return alias.replace('-', '.').replace('_', '.');
        }
    }

    /**
     * Splits a plain Gradle script into its statements. It knows comments, strings and brackets, and nothing else of
     * Kotlin.
     */
    static final class KotlinScript {
        /** {@code head { body }} if {@code block} is true, otherwise a head alone. */
        record Statement(String head, boolean block, String body) {
            List<Statement> inner(String file) {
                return statements(file, body);
            }
        }

        private static final Pattern COMMENT = Pattern.compile("//.*|(?s:/\\*.*?(?:\\*/|$))");
        private static final Pattern STRING = Pattern.compile("\"(?:[^\"\\\\\\n]|\\\\.)*\"");
        private static final Pattern TOKEN = Pattern.compile(COMMENT + "|\"\"\"|" + STRING + "|(?s:.)");

        private KotlinScript() {}

        static List<Statement> statements(String file, String script) {
            var statements = new ArrayList<Statement>();
            var text = new StringBuilder();
            int depth = 0;
            int brace = -1; // where the last block of the statement begins
            for (var match : TOKEN.matcher(script + "\n").results().toList()) {
                var token = match.group();
                if (token.equals("\"\"\"")) {
                    throw new NotUnderstood("a raw string is not understood here");
                } else if (token.equals("\"")) {
                    var line =
                            script.substring(match.start()).lines().findFirst().orElse("");
                    throw new NotUnderstood("a string is not closed: " + line);
                } else if ("({[".contains(token)) {
                    brace = token.equals("{") && depth == 0 ? text.length() : brace;
                    depth++;
                } else if (")}]".contains(token) && --depth < 0) {
                    throw new NotUnderstood(file + ": a " + token + " that nothing opened");
                }
                if ((token.equals("\n") || token.equals(";")) && depth == 0) {
                    add(statements, text.toString().stripTrailing(), brace);
                    text.setLength(0);
                    brace = -1;
                } else if (!COMMENT.matcher(token).matches()) {
                    text.append(token);
                }
            }
            NotUnderstood.unless(depth == 0, file + ": a bracket is not closed");
            return statements;
        }

        private static void add(List<Statement> statements, String text, int brace) {
            if (brace >= 0 && text.endsWith("}")) {
                statements.add(new Statement(
                        text.substring(0, brace).strip(), true, text.substring(brace + 1, text.length() - 1)));
            } else if (!text.isBlank()) {
                statements.add(new Statement(text.strip(), false, ""));
            }
        }
    }
}
