package io.troupe.petri.wiring;

import io.troupe.petri.wiring.RecordedProtocols.Component;
import io.troupe.petri.wiring.RecordedProtocols.Edge;
import java.lang.reflect.Modifier;
import java.util.Collection;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeSet;
import java.util.function.UnaryOperator;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import org.jspecify.annotations.Nullable;

/** Recorded protocols as a source file, in Java and Kotlin. */
final class RecordedSource {
    private static final String BODY = "\n        ";
    private static final String JAVA = BODY + "        "; // a line that continues a statement
    private static final String KOTLIN = BODY + "    ";

    private final RecordedProtocols recording;
    private final String packageName;
    private final UnaryOperator<String> escape;
    private final Map<String, String> variables = new HashMap<>(); // by component

    private RecordedSource(RecordedProtocols recording, String packageName, UnaryOperator<String> escape) {
        this.recording = recording;
        this.packageName = packageName;
        this.escape = escape;
        var used = new HashSet<String>();
        recording.components().forEach(component -> {
            String first = variable(component.name);
            String variable = first;
            for (int count = 2; !used.add(variable); count++) {
                variable = first + "_" + count;
            }
            variables.put(component.name, variable);
        });
    }

    private static String variable(String component) {
        String name = component.replaceAll("[^\\p{L}\\p{N}]+", "_");
        return "of" + Character.toUpperCase(name.charAt(0)) + name.substring(1);
    }

    static String java(RecordedProtocols recording, String packageName, String className) {
        return new RecordedSource(recording, packageName, RecordedSource::escaped).java(className);
    }

    static String kotlin(RecordedProtocols recording, String packageName, String objectName) {
        return new RecordedSource(recording, packageName, text -> escaped(text).replace("$", "\\$")).kotlin(objectName);
    }

    private static String escaped(String text) {
        return text.replace("\\", "\\\\")
                .replace("\"", "\\\"")
                .replace("\n", "\\n")
                .replace("\r", "\\r");
    }

    private String java(String className) {
        var text = new StringBuilder("package " + packageName + ";\n\n");
        verbs().forEach(verb -> text.append("import static io.troupe.petri.wiring.Protocol.")
                .append(verb)
                .append(";\n"));
        text.append("\n");
        imports().forEach(type -> text.append("import ").append(type).append(";\n"));
        text.append("\n/** Recorded from runs: a draft. */\nfinal class ")
                .append(className)
                .append(" {\n");
        text.append("    private ").append(className).append("() {}\n\n    static Wiring wiring() {\n");
        for (var component : recording.components()) {
            text.append(protocol(component, "var", ".class", JAVA)).append(";\n");
        }
        text.append(whole(JAVA)).append(";\n    }\n}\n");
        return text.toString();
    }

    private String kotlin(String objectName) {
        var text = new StringBuilder("package " + packageName + "\n\n");
        Stream.concat(imports().stream(), verbs().stream().map(verb -> "io.troupe.petri.wiring.Protocol." + verb))
                .sorted()
                .forEach(name -> text.append("import ").append(name).append("\n"));
        text.append("\n/** Recorded from runs: a draft. */\ninternal object ")
                .append(objectName)
                .append(" {\n");
        text.append("    fun wiring(): Wiring {\n");
        for (var component : recording.components()) {
            text.append(protocol(component, "val", "::class.java", KOTLIN)).append("\n");
        }
        text.append(whole(KOTLIN)).append("\n    }\n}\n");
        return text.toString();
    }

    private String quoted(String text) {
        return "\"" + escape.apply(text) + "\"";
    }

    private String protocol(Component component, String declares, String classSuffix, String line) {
        var text = new StringBuilder("        " + declares + " " + variables.get(component.name) + " = Protocol.of(");
        text.append(quoted(component.name)).append(type(component, classSuffix)).append(")");
        component.states.forEach((state, edges) -> text.append(state(state, edges, line)));
        return text.append(line).append(".build()").toString();
    }

    private Collection<String> verbs() {
        return recording.components().stream()
                .flatMap(component -> component.states.values().stream())
                .flatMap(Set::stream)
                .map(Edge::verb)
                .collect(Collectors.toCollection(TreeSet::new));
    }

    private List<String> imports() {
        var names = new TreeSet<>(List.of("io.troupe.petri.wiring.Protocol", "io.troupe.petri.wiring.Wiring"));
        if (!recording.mailboxes().isEmpty()) {
            names.add("io.troupe.petri.wiring.Overflow");
        }
        return List.copyOf(names);
    }

    /** The type as an argument, if a class of this package may name it. */
    private String type(Component component, String suffix) {
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

    private String state(String state, Set<Edge> edges, String line) {
        String step = line + line.substring(BODY.length()); // indented once more
        return edges.stream()
                .map(edge -> edge.verb() + "(" + quoted(edge.what()) + ").then(" + quoted(edge.to()) + ")")
                .collect(Collectors.joining("," + step, line + ".state(" + step + quoted(state) + "," + step, ")"));
    }

    private String whole(String line) {
        var text = new StringBuilder("        return Wiring.of(" + quoted(recording.name()) + ")");
        recording
                .components()
                .forEach(component -> text.append(line + ".component(")
                        .append(quoted(component.name))
                        .append(", ")
                        .append(variables.get(component.name))
                        .append(")"));
        recording
                .mailboxes()
                .forEach((component, capacity) -> text.append(line + ".mailbox(")
                        .append(quoted(component))
                        .append(", ")
                        .append(capacity)
                        .append(", Overflow.BLOCK)"));
        return text.append(line).append(".build()").toString();
    }
}
