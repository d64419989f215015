package io.troupe.petri.bip;

import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.stream.Collectors;
import java.util.stream.IntStream;

/**
 * Writes a model in the BIP 2 language: one package with the types, and the compound {@code Top}.
 *
 * {@snippet :
 * Files.writeString(directory.resolve(model.name() + ".bip"), BipText.of(model));
 * }
 *
 * <p><b>Order.</b> The same model gives the same text.
 *
 * <p><b>Units and shapes.</b> The compiler finds a package by the name of its file, {@code NAME.bip}. Priorities are
 * written with all that follow from them, so that it does not matter whether a tool takes them as transitive.
 */
public final class BipText {
    private static final int MOST_COLUMNS = 110;

    private final BipModel model;
    private final StringBuilder text = new StringBuilder();
    /** Connector types by their pattern of triggers, such as {@code tss}. */
    private final Map<String, String> shapes = new LinkedHashMap<>();

    private final String portType;

    private BipText(BipModel model) {
        this.model = model;
        portType = fresh("Signal");
        for (var connector : model.connectors()) {
            shapes.computeIfAbsent(shape(connector), this::shapeName);
        }
    }

    /** The text of a model. */
    public static String of(BipModel model) {
        return new BipText(model).write();
    }

    private String write() {
        text.append("package ").append(model.name()).append('\n');
        text.append("  port type ").append(portType).append("()\n");
        shapes.forEach(this::connectorType);
        model.types().forEach(this::atomType);
        text.append("\n  compound type ").append(fresh("Top")).append("()\n");
        model.components()
                .forEach((name, type) -> line("    component " + type.name() + " ", List.of(name + "()"), ""));
        for (var connector : model.connectors()) {
            line(
                    "    connector " + shapes.get(shape(connector)) + " " + connector.name() + "(",
                    connector.ends().stream().map(Connector.End::toString).toList(),
                    ")");
        }
        var priorities = model.allPriorities();
        for (var i = 0; i < priorities.size(); i++) {
            var priority = priorities.get(i);
            text.append("    priority rule").append(i + 1).append(' ').append(priority.low());
            text.append(":* < ").append(priority.high()).append(":*\n");
        }
        return text.append("  end\nend\n").toString();
    }

    private static String shape(Connector connector) {
        return connector.ends().stream().map(end -> end.trigger() ? "t" : "s").collect(Collectors.joining());
    }

    private String shapeName(String shape) {
        return fresh(shape.contains("t") ? "Broadcast_" + shape : "Rendezvous" + shape.length());
    }

    /** A name that no atom type has. */
    private String fresh(String name) {
        return model.types().stream().anyMatch(type -> type.name().equals(name)) ? fresh(name + "_") : name;
    }

    private void connectorType(String shape, String name) {
        text.append('\n');
        line(
                "  connector type " + name + "(",
                IntStream.rangeClosed(1, shape.length())
                        .mapToObj(i -> portType + " p" + i)
                        .toList(),
                ")");
        text.append("    define");
        for (var i = 0; i < shape.length(); i++) {
            text.append(" p").append(i + 1).append(shape.charAt(i) == 't' ? "'" : "");
        }
        text.append("\n  end\n");
    }

    private void atomType(AtomType type) {
        text.append("\n  atom type ").append(type.name()).append("()\n");
        if (!type.ports().isEmpty()) {
            line(
                    "    export port " + portType + " ",
                    type.ports().stream().map(port -> port + "()").toList(),
                    "");
        }
        line("    place ", type.places(), "");
        text.append("    initial to ").append(type.initial()).append('\n');
        type.steps().forEach(step -> text.append("    ").append(step).append('\n'));
        text.append("  end\n");
    }

    /** Writes a list with commas, in as many lines as it needs. */
    private void line(String before, List<String> parts, String after) {
        var indent = " ".repeat(before.length() - before.stripLeading().length() + 4);
        var lines = new ArrayList<String>();
        var line = new StringBuilder(before);
        for (var i = 0; i < parts.size(); i++) {
            var part = parts.get(i) + (i < parts.size() - 1 ? "," : after);
            if (i > 0 && line.length() + 1 + part.length() > MOST_COLUMNS) {
                lines.add(line.toString());
                line = new StringBuilder(indent);
            } else if (i > 0) {
                line.append(' ');
            }
            line.append(part);
        }
        lines.add(line.toString());
        lines.forEach(each -> text.append(each).append('\n'));
    }
}
