package io.troupe.petri.wiring;

import io.troupe.petri.wiring.RecordedProtocols.Component;
import io.troupe.petri.wiring.RecordedProtocols.Edge;
import java.lang.reflect.Modifier;
import java.util.Collection;
import java.util.List;
import java.util.Set;
import java.util.TreeSet;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/** Recorded protocols as a source file, in Java and Kotlin. */
final class RecordedSource {
    private static final String BODY = "\n        ";
    private static final String JAVA = BODY + "        "; // a line that continues a statement
    private static final String KOTLIN = BODY + "    ";

    private RecordedSource() {}

    static String java(RecordedProtocols recording, String packageName, String className) {
        var text = new StringBuilder("package " + packageName + ";\n\n");
        verbs(recording)
                .forEach(verb -> text.append("import static io.troupe.petri.wiring.Protocol.")
                        .append(verb)
                        .append(";\n"));
        text.append("\n");
        imports(recording).forEach(type -> text.append("import ").append(type).append(";\n"));
        text.append("\n/** Recorded from runs: a draft. */\nfinal class ")
                .append(className)
                .append(" {\n");
        text.append("    private ").append(className).append("() {}\n\n    static Wiring wiring() {\n");
        for (var component : recording.components()) {
            text.append("        var ")
                    .append(variable(component))
                    .append(" = Protocol.of(\"")
                    .append(component.name);
            text.append("\"").append(type(component, packageName, ".class")).append(")");
            component.states.forEach((state, edges) -> text.append(state(state, edges, JAVA)));
            text.append(JAVA).append(".build();\n");
        }
        text.append("        return Wiring.of(\"").append(recording.name()).append("\")");
        text.append(whole(recording, JAVA)).append(JAVA).append(".build();\n    }\n}\n");
        return text.toString();
    }

    static String kotlin(RecordedProtocols recording, String packageName, String objectName) {
        var text = new StringBuilder("package " + packageName + "\n\n");
        Stream.concat(
                        imports(recording).stream(),
                        verbs(recording).stream().map(verb -> "io.troupe.petri.wiring.Protocol." + verb))
                .sorted()
                .forEach(name -> text.append("import ").append(name).append("\n"));
        text.append("\n/** Recorded from runs: a draft. */\ninternal object ")
                .append(objectName)
                .append(" {\n");
        text.append("    fun wiring(): Wiring {\n");
        for (var component : recording.components()) {
            text.append("        val ")
                    .append(variable(component))
                    .append(" = Protocol.of(\"")
                    .append(component.name);
            text.append("\"")
                    .append(type(component, packageName, "::class.java"))
                    .append(")");
            component.states.forEach((state, edges) -> text.append(state(state, edges, KOTLIN)));
            text.append(KOTLIN).append(".build()\n");
        }
        text.append("        return Wiring.of(\"").append(recording.name()).append("\")");
        text.append(whole(recording, KOTLIN)).append(KOTLIN).append(".build()\n    }\n}\n");
        return text.toString();
    }

    private static Collection<String> verbs(RecordedProtocols recording) {
        return recording.components().stream()
                .flatMap(component -> component.states.values().stream())
                .flatMap(Set::stream)
                .map(Edge::verb)
                .collect(Collectors.toCollection(TreeSet::new));
    }

    private static List<String> imports(RecordedProtocols recording) {
        var names = new TreeSet<>(List.of("io.troupe.petri.wiring.Protocol", "io.troupe.petri.wiring.Wiring"));
        if (!recording.mailboxes().isEmpty()) {
            names.add("io.troupe.petri.wiring.Overflow");
        }
        return List.copyOf(names);
    }

    /** The type as an argument, if a class of this package may name it. */
    private static String type(Component component, String packageName, String suffix) {
        return component.type != null && isVisible(component.type, packageName)
                ? ", " + component.type.getCanonicalName() + suffix
                : "";
    }

    private static boolean isVisible(Class<?> type, String packageName) {
        if (type.getCanonicalName() == null) {
            return false; // a local one
        }
        @Nullable Class<?> each = type;
        while (each != null) {
            boolean isPublic = Modifier.isPublic(each.getModifiers());
            boolean isOwn = each.getPackageName().equals(packageName) && !Modifier.isPrivate(each.getModifiers());
            if (!isPublic && !isOwn) {
                return false;
            }
            each = each.getEnclosingClass();
        }
        return true;
    }

    private static String state(String state, Set<Edge> edges, String line) {
        String step = line + line.substring(BODY.length()); // indented once more
        return edges.stream()
                .map(edge -> edge.verb() + "(\"" + edge.what() + "\").then(\"" + edge.to() + "\")")
                .collect(Collectors.joining("," + step, line + ".state(" + step + "\"" + state + "\"," + step, ")"));
    }

    private static String whole(RecordedProtocols recording, String line) {
        var text = new StringBuilder();
        recording
                .components()
                .forEach(component -> text.append(line + ".component(\"")
                        .append(component.name)
                        .append("\", ")
                        .append(variable(component))
                        .append(")"));
        recording
                .mailboxes()
                .forEach((component, capacity) -> text.append(line + ".mailbox(\"")
                        .append(component)
                        .append("\", ")
                        .append(capacity)
                        .append(", Overflow.BLOCK)"));
        return text.toString();
    }

    private static String variable(Component component) {
        String name = component.name.replaceAll("[^\\p{L}\\p{N}]+", "_");
        return "of" + Character.toUpperCase(name.charAt(0)) + name.substring(1);
    }
}
