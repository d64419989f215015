package io.troupe.checks.builds;

import io.troupe.checks.builds.Build.Dependency;
import io.troupe.checks.builds.Build.Module;
import io.troupe.checks.builds.Build.NotUnderstood;
import io.troupe.checks.builds.Build.Scope;
import java.io.IOException;
import java.io.StringReader;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.SortedMap;
import java.util.TreeMap;
import java.util.TreeSet;
import java.util.regex.Pattern;
import java.util.stream.IntStream;
import javax.xml.parsers.DocumentBuilderFactory;
import javax.xml.parsers.ParserConfigurationException;
import org.w3c.dom.Element;
import org.xml.sax.InputSource;
import org.xml.sax.SAXException;

/**
 * The Maven build, read from its POMs without running Maven.
 *
 * <p><b>Errors.</b> As in {@link GradleReader}: a part that it does not understand, and that Gradle would have to
 * repeat, is a {@link NotUnderstood}.
 */
final class PomReader {
    private static final Set<String> UNDERSTOOD = words("modelVersion parent groupId artifactId version packaging name"
            + " description url inceptionYear licenses developers scm modules properties dependencies build profiles");
    private static final Set<String> IN_DEPENDENCY = words("groupId artifactId version type scope exclusions");
    private static final Set<String> IN_PROFILE = words("id activation properties build");
    /** Those that may be configured in a profile: Gradle has no counterpart of what they do there. */
    private static final Set<String> PLUGINS_IN_PROFILE =
            words("maven-clean-plugin maven-compiler-plugin maven-jar-plugin maven-javadoc-plugin");

    /** The execution that compiles descriptors of modules, for an older Java than the classes. */
    private static final String OF_DESCRIPTORS = "module-info";

    private static final String KOTLIN_PLUGIN = "kotlin-maven-plugin";
    private static final String EXEC_PLUGIN = "exec-maven-plugin";
    private static final Pattern PROGRAM =
            Pattern.compile("((?:-\\S+ )*)-classpath %classpath ([\\w.]+) \\$\\{\\w+}.*");
    private static final Pattern PROPERTY = Pattern.compile("\\$\\{([^}]+)}");

    private final Map<String, String> shared = new LinkedHashMap<>();
    private final List<Element> forAll;
    private final List<Element> managedPlugins;
    private final List<String> modules;

    private PomReader(Element root) {
        requireUnderstood("pom.xml", root);
        shared.putAll(properties(root));
        shared.put("project.groupId", text(root, "groupId"));
        shared.put("project.version", text(root, "version"));
        forAll = all(root, "dependencies", "dependency");
        managedPlugins = all(root, "build", "pluginManagement", "plugins", "plugin");
        modules = all(root, "modules", "module").stream().map(PomReader::text).toList();
    }

    static Build read(Path root) throws IOException {
        var reader = new PomReader(parse("pom.xml", Files.readString(root.resolve("pom.xml"))));
        Map<String, Module> modules = new LinkedHashMap<>();
        for (String folder : reader.modules) {
            var file = folder + "/pom.xml";
            var name = folder.substring(folder.lastIndexOf('/') + 1);
            modules.put(name, reader.readModule(file, name, parse(file, Files.readString(root.resolve(file)))));
        }
        var owner = new TreeMap<>(reader.shared);
        owner.keySet().removeIf(name -> !name.startsWith(Build.OWNER));
        return new Build("Maven", reader.value("project.groupId"), reader.value("project.version"), owner, modules);
    }

    static Module module(String rootPom, String name, String pom) {
        return new PomReader(parse("pom.xml", rootPom)).readModule(name + "/pom.xml", name, parse(name, pom));
    }

    private Module readModule(String file, String name, Element project) {
        requireUnderstood(file, project);
        var parent = all(project, "parent").getFirst();
        require(file, "parent's version", text(parent, "version"), value("project.version"));
        require(file, "parent's groupId", text(parent, "groupId"), value("project.groupId"));
        require(file, "artifactId", text(project, "artifactId"), Module.artifact(name));
        Map<String, String> properties = new LinkedHashMap<>(shared);
        properties.putAll(properties(project));

        List<Dependency> dependencies = new ArrayList<>();
        forAll.forEach(each -> dependencies.add(dependency("pom.xml", each, properties)));
        all(project, "dependencies", "dependency")
                .forEach(each -> dependencies.add(dependency(file, each, properties)));
        var kotlin = new TreeSet<String>();
        var programs = new TreeMap<String, String>();
        for (Element plugin : all(project, "build", "plugins", "plugin")) {
            if (text(plugin, "artifactId").equals(KOTLIN_PLUGIN)) {
                kotlin.addAll(kotlin(plugin, properties));
            }
            if (text(plugin, "artifactId").equals(EXEC_PLUGIN)) {
                readPrograms(file, plugin, programs);
            }
            for (Element path : all(plugin, "configuration", "annotationProcessorPaths", "path")) {
                var processor = dependency(file, path, properties);
                dependencies.add(new Dependency(Scope.PROCESSOR, processor.coordinates(), processor.version()));
            }
        }
        return new Module(
                text(project, "description"),
                interpolate("${maven.compiler.release}", properties),
                properties.getOrDefault("module.name", ""),
                kotlin,
                programs,
                dependencies);
    }

    /** The executions that start a program, and the main job, which is started without the name of an execution. */
    private static void readPrograms(String file, Element plugin, SortedMap<String, String> programs) {
        readProgram(file, "run", plugin, programs);
        for (Element execution : all(plugin, "executions", "execution")) {
            readProgram(file, text(execution, "id"), execution, programs);
        }
    }

    /** All modules inherit that programs are skipped, so that only the one that is named starts. */
    private static void readProgram(String file, String name, Element from, SortedMap<String, String> programs) {
        for (Element configuration : all(from, "configuration")) {
            var command = text(configuration, "commandlineArgs");
            var program = PROGRAM.matcher(command);
            if (!command.isEmpty()) {
                NotUnderstood.unless(
                        program.matches(),
                        file + ": in " + name + " expected OPTIONS -classpath %classpath MAIN ${..}, found " + command);
                var skip = text(configuration, "skip");
                NotUnderstood.unless(
                        skip.equals("false") || skip.equals("${skipTests}"),
                        file + ": " + name + " is skipped by default, expected <skip>false</skip>");
                programs.put(name, program.group(1) + program.group(2));
            }
        }
    }

    /** The version of Kotlin's compiler and its arguments, as in {@link Module}. */
    private Set<String> kotlin(Element plugin, Map<String, String> properties) {
        var found = new TreeSet<String>();
        managedPlugins.stream()
                .filter(each -> text(each, "artifactId").equals(KOTLIN_PLUGIN))
                .forEach(each -> found.add("compiler " + interpolate(text(each, "version"), properties)));
        all(plugin, "configuration", "jvmTarget")
                .forEach(each -> found.add("-jvm-target " + interpolate(text(each), properties)));
        var main = kotlinArguments(plugin, "compile");
        var test = kotlinArguments(plugin, "test-compile");
        main.forEach(each -> found.add(test.contains(each) ? each : "main " + each));
        test.forEach(each -> found.add(main.contains(each) ? each : "test " + each));
        return found;
    }

    private static Set<String> kotlinArguments(Element plugin, String goal) {
        var arguments = new TreeSet<String>();
        for (Element execution : all(plugin, "executions", "execution")) {
            if (all(execution, "goals", "goal").stream()
                    .anyMatch(each -> text(each).equals(goal))) {
                all(execution, "configuration", "args", "arg").forEach(each -> arguments.add(text(each)));
            }
        }
        return arguments;
    }

    private static Dependency dependency(String file, Element dependency, Map<String, String> properties) {
        requireOnly(IN_DEPENDENCY, file, dependency, " in a dependency");
        var group = interpolate(text(dependency, "groupId"), properties);
        var artifact = interpolate(text(dependency, "artifactId"), properties);
        var version = interpolate(text(dependency, "version"), properties);
        var type = text(dependency, "type");
        NotUnderstood.unless(
                type.isEmpty() || type.equals("test-jar"),
                file + ": <type>" + type + "</type> is not understood, expected test-jar");
        var tests = type.isEmpty() ? "" : ":tests";
        var excluded = all(dependency, "exclusions", "exclusion").stream()
                .map(each -> text(each, "groupId") + ":" + text(each, "artifactId"))
                .toList();
        var scope = scope(interpolate(text(dependency, "scope"), properties));
        return new Dependency(scope, group + ":" + artifact + tests, version).excluding(excluded);
    }

    private static Scope scope(String text) {
        return switch (text) {
            case "", "compile" -> Scope.COMPILE;
            case "provided" -> Scope.PROVIDED;
            case "runtime" -> Scope.RUNTIME;
            case "test" -> Scope.TEST;
            default -> throw new NotUnderstood("scope " + text + " is not understood");
        };
    }

    /** Rejects everything else that could add a dependency or change the release level. */
    private static void requireUnderstood(String file, Element project) {
        requireOnly(UNDERSTOOD, file, project, "");
        for (Element profile : all(project, "profiles", "profile")) {
            requireOnly(IN_PROFILE, file, profile, " in a profile");
            for (Element plugin : within(profile, "plugin")) {
                var name = text(plugin, "artifactId");
                NotUnderstood.unless(
                        PLUGINS_IN_PROFILE.contains(name)
                                && within(plugin, "dependency").isEmpty()
                                && within(plugin, "annotationProcessorPaths").isEmpty(),
                        file + ": the plugin " + name + " in a profile is not understood");
            }
        }
        for (String name : List.of("release", "source", "target", "testRelease")) {
            NotUnderstood.unless(
                    within(project, name).stream()
                            .allMatch(
                                    each -> text((Element) each.getParentNode().getParentNode(), "id")
                                            .equals(OF_DESCRIPTORS)),
                    file + ": <" + name + "> is not understood, the level is the property maven.compiler.release");
        }
    }

    private static List<Element> within(Element parent, String name) {
        var found = parent.getElementsByTagName(name);
        return IntStream.range(0, found.getLength())
                .mapToObj(found::item)
                .map(Element.class::cast)
                .toList();
    }

    private static void requireOnly(Set<String> understood, String file, Element parent, String where) {
        for (Element child : children(parent)) {
            NotUnderstood.unless(
                    understood.contains(child.getTagName()),
                    file + ": <" + child.getTagName() + ">" + where + " is not understood");
        }
    }

    private static Set<String> words(String text) {
        return Set.of(text.split(" "));
    }

    private static void require(String file, String what, String value, String expected) {
        NotUnderstood.unless(value.equals(expected), file + ": " + what + " is " + value + ", expected " + expected);
    }

    private String value(String property) {
        return interpolate("${" + property + "}", shared);
    }

    private static String interpolate(String text, Map<String, String> properties) {
        return PROPERTY.matcher(text).replaceAll(match -> {
            var value = properties.get(match.group(1));
            if (value == null) {
                throw new NotUnderstood("POM: no property " + match.group(1));
            }
            return value;
        });
    }

    private static Map<String, String> properties(Element project) {
        Map<String, String> properties = new LinkedHashMap<>();
        all(project, "properties")
                .forEach(each ->
                        children(each).forEach(property -> properties.put(property.getTagName(), text(property))));
        return properties;
    }

    private static List<Element> all(Element from, String... path) {
        List<Element> found = List.of(from);
        for (String name : path) {
            found = found.stream()
                    .flatMap(each -> children(each).stream())
                    .filter(each -> each.getTagName().equals(name))
                    .toList();
        }
        return found;
    }

    private static List<Element> children(Element parent) {
        var nodes = parent.getChildNodes();
        return IntStream.range(0, nodes.getLength())
                .mapToObj(nodes::item)
                .filter(Element.class::isInstance)
                .map(Element.class::cast)
                .toList();
    }

    private static String text(Element parent, String child) {
        return all(parent, child).stream().map(PomReader::text).findFirst().orElse("");
    }

    private static String text(Element element) {
        return element.getTextContent().strip();
    }

    private static Element parse(String file, String xml) {
        try {
            var factory = DocumentBuilderFactory.newInstance();
            factory.setFeature("http://apache.org/xml/features/disallow-doctype-decl", true);
            return factory.newDocumentBuilder()
                    .parse(new InputSource(new StringReader(xml)))
                    .getDocumentElement();
        } catch (ParserConfigurationException | SAXException | IOException failure) {
            throw new NotUnderstood(file + ": " + failure.getMessage());
        }
    }
}
