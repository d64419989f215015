package io.troupe.services.subsumption;

import static java.util.Objects.requireNonNull;

import io.troupe.common.text.Suggestions;
import io.troupe.services.behaviour.Behaviour;
import io.troupe.services.subsumption.ServiceCatalogue.Kind;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.function.Supplier;

/** Parses services in a table file: their declarations, and their names with {@code >} between layers. */
final class ServiceReader {
    private final ServiceCatalogue catalogue;
    private final Map<String, Service> declared = new LinkedHashMap<>();

    ServiceReader(ServiceCatalogue catalogue) {
        this.catalogue = catalogue;
    }

    /** {@code NAME = KIND(ARGUMENTS)}, optionally followed by {@code colours} or {@code no colours}. */
    Service declare(TableLine line) {
        int at = line.position();
        String name = line.word("the name of a service");
        if (declared.containsKey(name)) {
            throw line.problem(at, "the service " + name + " is declared already, expected another name");
        }
        line.expect("=", "after the name of a service");
        int kindAt = line.position();
        String kindName = line.word("a kind of service");
        Kind kind = catalogue.kind(kindName);
        if (kind == null) {
            throw line.problem(
                    kindAt,
                    "there is no kind of service called '" + kindName + "'"
                            + Suggestions.expected("one of", kindName, catalogue.names()));
        }
        if (catalogue.kind(name) != null && !name.equals(kindName)) {
            throw line.problem(
                    at,
                    "a service of the kind " + kindName + " is called " + name
                            + ", which is another kind, expected another name");
        }
        var arguments = new ServiceArguments(line);
        boolean findsColours = line.skips("colours") || !skipsNoColours(line) && kind.findsColours();
        var service = new Service(name, findsColours, kind.usesLaser(), define(line, kindAt, kind, arguments));
        declared.put(name, service);
        return service;
    }

    private static boolean skipsNoColours(TableLine line) {
        if (!line.skips("no")) {
            return false;
        }
        line.expect("colours", "after 'no'");
        return true;
    }

    private static ServiceDefinition define(TableLine line, int kindAt, Kind kind, ServiceArguments arguments) {
        Supplier<Behaviour> maker;
        try {
            maker = requireNonNull(kind.maker().apply(arguments), "its maker answered nothing");
        } catch (SubsumptionTableException located) {
            throw located;
        } catch (IllegalArgumentException refused) {
            throw line.problem(kindAt, kind.name() + ": " + refused.getMessage());
        } catch (RuntimeException | LinkageError thrown) { // a bug in the kind, which may come from a user's jar
            var problem = line.problem(
                    kindAt, "the kind of service " + kind.name() + " threw " + thrown + ", expected its behaviour");
            problem.initCause(thrown);
            throw problem;
        }
        arguments.rejectUnused(kind.name());
        return new ServiceDefinition(kind.name(), arguments.text(), kind.yields(), maker);
    }

    /** {@code NAME > NAME > ..}, the highest layer first. */
    Service layers(TableLine line) {
        Service service = named(line);
        while (line.skips(">")) {
            service = service.over(named(line));
        }
        if (line.isAt("(")) {
            throw line.problem(
                    line.position(),
                    "arguments of " + service + ", expected them where it gets a name: 'service NAME = KIND(..)'");
        }
        return service;
    }

    private Service named(TableLine line) {
        int at = line.position();
        String name = line.word("a service");
        Service service = declared.get(name);
        if (service != null) {
            return service;
        }
        Kind kind = catalogue.kind(name);
        if (kind == null) {
            var known = new ArrayList<>(declared.keySet());
            catalogue.names().stream()
                    .filter(each -> !declared.containsKey(each))
                    .forEach(known::add);
            throw line.problem(
                    at, "there is no service called '" + name + "'" + Suggestions.expected("one of", name, known));
        }
        return new Service(
                name,
                kind.findsColours(),
                kind.usesLaser(),
                define(line, at, kind, new ServiceArguments(new TableLine(Path.of(""), 0, ""))));
    }
}
