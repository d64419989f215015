package io.troupe.demo.verify;

import io.troupe.broker.Need;
import io.troupe.bus.BusTopic;
import io.troupe.petri.bip.AtomType;
import io.troupe.petri.bip.BipModel;
import io.troupe.petri.bip.BipStates;
import io.troupe.services.component.Component;
import io.troupe.services.component.application.ApplicationPlan;
import io.troupe.services.component.application.ApplicationPlan.Replacement;
import io.troupe.services.component.application.ApplicationPlan.Wire;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Set;
import java.util.TreeSet;
import java.util.stream.Stream;

/**
 * The BIP model of a declared application: its components, its needs, its replacements and the application itself are
 * components of the model; what the broker and the bus do between them are connectors.
 *
 * <p><b>Behaviour.</b> A component has the states of {@code ManagedProvider} and a port for each topic, which is
 * enabled while it runs. A need asks when the application has met the needs before it, chooses a provider, starts it if
 * necessary, and uses it until it fails.
 *
 * <p><b>Interaction.</b> The failure of a component is a trigger, with its users as synchrons, because all of them are
 * notified at once; so are the exchange of one provider for another, and the publications on wires that are declared. A
 * value passes from a user to its provider, or back, in a rendezvous with the need that connects them.
 *
 * <p><b>Priority.</b> The broker prefers a provider that runs to one that is starting, that to one that has to be
 * started, and of those the first that is registered; a need has no provider only if it can choose none. A value is
 * published without a subscriber only while it has none.
 *
 * <p>The model has no data and no time. It leaves out that a provider may be suspect, and the order in which the
 * application stops its components. A failed component is started again only while a need waits for it. At its end the
 * application closes its needs one after the other.
 *
 * <p><b>Source.</b> The classes {@code ManagedProvider}, {@code BrokerActor}, {@code Application} and
 * {@code TopicWiring}.
 */
final class ApplicationBip {
    static final String APPLICATION = "application";

    private final ApplicationPlan plan;
    private final Map<String, String> names = new HashMap<>();
    private final BipModel.Builder model;
    private final Map<AtomType, AtomType> types = new HashMap<>();
    private final List<String> typeNames = new ArrayList<>();

    private ApplicationBip(ApplicationPlan plan) {
        this.plan = plan;
        var taken = new TreeSet<>(Set.of(APPLICATION));
        plan.components().keySet().forEach(each -> names.put(each, identifier(each, taken)));
        model = BipModel.named(identifier(plan.name(), new TreeSet<>()));
    }

    /**
     * The model of an application.
     *
     * @throws IllegalArgumentException if a component takes part in two replacements, which the model does not have
     */
    static BipModel of(ApplicationPlan plan) {
        return new ApplicationBip(plan).build();
    }

    /** The name of a component in the model. */
    static String name(ApplicationPlan plan, String component) {
        return new ApplicationBip(plan).name(component);
    }

    /** Whether the application has ended, also because a need was not met. */
    static boolean hasEnded(BipStates.State state) {
        return state.isIn(APPLICATION, "ended");
    }

    /**
     * The topics that the needs feed, by the needs and their providers: a robot is driven by two if two of them are in
     * use at the same time.
     */
    static Map<String, List<String>> fed(ApplicationPlan plan) {
        var derivation = new ApplicationBip(plan);
        var fed = new LinkedHashMap<String, List<String>>();
        for (var i = 0; i < plan.needs().size(); i++) {
            for (var candidate : derivation.candidates(plan.needs().get(i))) {
                for (var wire : plan.wiresBetween(plan.needs().get(i).by(), candidate)) {
                    fed.computeIfAbsent(wire.to().name(), topic -> new ArrayList<>())
                            .add(need(i) + ".using_" + derivation.names.get(candidate));
                }
            }
        }
        return fed;
    }

    /** A name of the BIP language that is not taken yet. */
    private static String identifier(String name, Set<String> taken) {
        var plain = name.replaceAll("[^A-Za-z0-9_]", "_");
        var free = plain.matches("[0-9].*") ? "_" + plain : plain;
        while (!isName(free) || taken.contains(free)) {
            free += "_";
        }
        taken.add(free);
        return free;
    }

    private static boolean isName(String name) {
        try {
            AtomType.starting(name, "here");
            return true;
        } catch (IllegalArgumentException reserved) {
            return false;
        }
    }

    private BipModel build() {
        for (var replacement : plan.replacements()) {
            for (var each : List.of(replacement.old(), replacement.by())) {
                var count = plan.replacements().stream()
                        .filter(other -> other.old().equals(each) || other.by().equals(each))
                        .count();
                if (count > 1) {
                    throw new IllegalArgumentException(
                            each + " takes part in " + count + " replacements, expected one: the model has no more");
                }
            }
        }
        model.component(APPLICATION, application());
        plan.components()
                .forEach((name, component) -> model.component(name(name), type(component.service(), component(name))));
        for (var i = 0; i < plan.needs().size(); i++) {
            model.component(need(i), type("Need", need(plan.needs().get(i))));
        }
        for (var i = 0; i < plan.replacements().size(); i++) {
            model.component(replacement(i), REPLACEMENT);
        }
        for (var i = 0; i < plan.needs().size(); i++) {
            connect(i, plan.needs().get(i));
        }
        for (var i = 0; i < plan.replacements().size(); i++) {
            connect(i, plan.replacements().get(i));
        }
        plan.components().keySet().forEach(this::connectLifecycle);
        plan.components().forEach(this::connectTopics);
        connectEnd();
        return model.build();
    }

    private String name(String component) {
        return names.getOrDefault(component, component);
    }

    private static String need(int number) {
        return "need" + (number + 1);
    }

    private static String replacement(int number) {
        return "replacement" + (number + 1);
    }

    /** One type for equal behaviours, whose name begins with the given one. */
    private AtomType type(String name, AtomType behaviour) {
        return types.computeIfAbsent(behaviour, unnamed -> {
            var taken = new TreeSet<>(typeNames);
            var plain = name.substring(0, 1).toUpperCase(Locale.ROOT) + name.substring(1);
            typeNames.add(identifier(plain, taken));
            return new AtomType(typeNames.getLast(), unnamed.initial(), unnamed.steps());
        });
    }

    // ---- behaviour

    private static AtomType each(AtomType type, String port, List<String> from, String to) {
        var more = type;
        for (var place : from) {
            more = more.on(port, place, to);
        }
        return more;
    }

    private static AtomType loops(AtomType type, String port, String... places) {
        var more = type;
        for (var place : places) {
            more = more.on(port, place, place);
        }
        return more;
    }

    private AtomType application() {
        var application = AtomType.starting("Application", plan.needs().isEmpty() ? "runs" : "asks1");
        var before = new ArrayList<String>();
        for (var i = 1; i <= plan.needs().size(); i++) {
            application = application
                    .on("ask" + i, "asks" + i, "waits" + i)
                    .on("met" + i, "waits" + i, i < plan.needs().size() ? "asks" + (i + 1) : "runs");
            before.addAll(List.of("asks" + i, "waits" + i));
        }
        before.add("runs");
        if (!plan.replacements().isEmpty()) {
            application = loops(application, "running", "runs");
        }
        var closes = plan.needs().size() + plan.replacements().size();
        application = each(application, "stop", before, closes > 0 ? "closes1" : "ending");
        if (!plan.needs().isEmpty()) {
            application = each(application, "missing", before, "closes1");
        }
        for (var i = 1; i <= closes; i++) {
            application = application.on("close" + i, "closes" + i, i < closes ? "closes" + (i + 1) : "ending");
        }
        return application.on("terminate", "ending", "ending").on("finish", "ending", "ended");
    }

    /** The automaton of {@code ManagedProvider}, without a name; a termination that fails leaves a failed component. */
    private AtomType component(String name) {
        var type = AtomType.starting("Component", "not_invoked");
        type = type.on("invoke", "not_invoked", "invoking")
                .on("invoked", "invoking", "running")
                .on("terminate", "invoking", "terminating")
                .on("terminate", "running", "terminating")
                .on("terminated", "terminating", "terminated_")
                .on("not_terminated", "terminating", "failed")
                .on("invoke", "terminated_", "invoking")
                .on("fails", "invoking", "failed")
                .on("fails", "running", "failed")
                .on("restart", "failed", "invoking");
        type = loops(loops(type, "begins", "invoking"), "serves", "running");
        type = loops(type, "rests", "not_invoked", "terminated_", "failed");
        var component = plan.components().get(name);
        for (var topic : topics(component)) {
            type = loops(type, port(name, topic), "running");
        }
        return type;
    }

    private static List<BusTopic<?>> topics(Component<?, ?> component) {
        return Stream.concat(component.publishes().stream(), component.subscribes().stream())
                .<BusTopic<?>>map(topic -> topic)
                .distinct()
                .toList();
    }

    /** The port of a topic: its last name, with the owner unless that is the component. */
    private static String port(String component, BusTopic<?> topic) {
        var name = topic.name();
        var plain = name.startsWith(component + "/") ? name.substring(component.length() + 1) : name;
        return "topic_" + plain.replaceAll("[^A-Za-z0-9_]", "_");
    }

    /** The components that may meet a need, in the order of their registration. */
    private List<String> candidates(Need need) {
        return plan.components().keySet().stream()
                .filter(name -> {
                    var component = plan.components().get(name);
                    var replaced = plan.replacements().stream()
                            .filter(each -> each.by().equals(name))
                            .map(each -> plan.components().get(each.old()))
                            .findFirst();
                    var service = replaced.map(Component::service).orElse(component.service());
                    var capabilities = new LinkedHashSet<>(component.capabilities());
                    replaced.ifPresent(old -> capabilities.addAll(old.capabilities()));
                    return (need.service() == null || need.service().equals(service))
                            && (need.capability() == null || capabilities.contains(need.capability()));
                })
                .toList();
    }

    private AtomType need(Need need) {
        var type = AtomType.starting("Need", "unasked").on("ask", "unasked", "choosing");
        var places = new ArrayList<>(List.of("unasked", "choosing", "unmet"));
        var wires = new LinkedHashSet<String>();
        for (var candidate : candidates(need)) {
            var name = name(candidate);
            type = type.on("use_" + name, "choosing", "using_" + name)
                    .on("join_" + name, "choosing", "starting_" + name)
                    .on("start_" + name, "choosing", "starting_" + name)
                    .on("began_" + name, "starting_" + name, "using_" + name)
                    .on("lost_" + name, "starting_" + name, "choosing")
                    .on("lost_" + name, "using_" + name, "choosing")
                    .on("restart_" + name, "unmet", "starting_" + name);
            type = loops(type, "met", "using_" + name);
            if (!plan.wiresBetween(need.by(), candidate).isEmpty()) {
                wires.add(name);
            }
            places.addAll(List.of("using_" + name, "starting_" + name));
        }
        for (var old : candidates(need)) {
            for (var replacement : plan.replacements()) {
                if (replacement.old().equals(old) && candidates(need).contains(replacement.by())) {
                    type = type.on("exchange_" + name(old), "using_" + name(old), "using_" + name(replacement.by()))
                            .on("exchange_" + name(old), "starting_" + name(old), "choosing");
                }
            }
        }
        for (var name : wires) {
            type = loops(type, "forward_" + name, "using_" + name);
        }
        type = type.on("none", "choosing", "unmet").on("give_up", "unmet", "gave_up");
        return loops(each(type, "close", places, "closed"), "close", "gave_up");
    }

    private static final AtomType REPLACEMENT = replacementType();

    private static AtomType replacementType() {
        var type = AtomType.starting("Replacement", "waiting")
                .on("begin", "waiting", "starting")
                .on("began", "starting", "switching")
                .on("lost", "starting", "refused")
                .on("lost", "switching", "refused")
                .on("exchange", "switching", "stopping")
                .on("terminate", "stopping", "stops")
                .on("stopped", "stops", "done")
                .on("stopped", "stopping", "done");
        type = loops(type, "before", "waiting", "starting", "switching", "refused");
        type = loops(type, "after", "stopping", "stops", "done");
        return each(
                type,
                "close",
                List.of("waiting", "starting", "switching", "stopping", "stops", "done", "refused"),
                "closed");
    }

    // ---- interaction and priority

    private void connect(int number, Need need) {
        var user = need(number);
        model.connector("ask" + (number + 1), APPLICATION + ".ask" + (number + 1), user + ".ask");
        var choices = new ArrayList<String>(); // the best first
        for (var step : List.of("use", "join", "start")) {
            for (var candidate : candidates(need)) {
                var name = name(candidate);
                var port = switch (step) {
                    case "use" -> "serves";
                    case "join" -> "begins";
                    default -> "invoke";
                };
                choices.add(gated(
                        user + "_" + step + "_" + name, candidate, user + "." + step + "_" + name, name + "." + port));
            }
        }
        for (var candidate : candidates(need)) {
            var name = name(candidate);
            gated(user + "_began_" + name, candidate, user + ".began_" + name, name + ".serves");
            gated(user + "_restart_" + name, candidate, user + ".restart_" + name, name + ".restart");
        }
        if (!candidates(need).isEmpty()) {
            model.connector("met" + (number + 1), APPLICATION + ".met" + (number + 1), user + ".met");
        }
        choices.add(user + "_none");
        model.connector(user + "_none", user + ".none");
        for (var i = 1; i < choices.size(); i++) {
            model.priority(choices.get(i), choices.get(i - 1));
        }
        model.connector(user + "_missing", APPLICATION + ".missing", user + ".give_up");
    }

    /** Adds a connector that also needs the candidate to be registered now. */
    private String gated(String connector, String candidate, String... ends) {
        var all = new ArrayList<>(List.of(ends));
        for (var i = 0; i < plan.replacements().size(); i++) {
            if (plan.replacements().get(i).old().equals(candidate)) {
                all.add(replacement(i) + ".before");
            } else if (plan.replacements().get(i).by().equals(candidate)) {
                all.add(replacement(i) + ".after");
            }
        }
        model.connector(connector, all.toArray(String[]::new));
        return connector;
    }

    private void connect(int number, Replacement what) {
        var atom = replacement(number);
        var old = name(what.old());
        var by = name(what.by());
        model.connector(atom + "_begin", APPLICATION + ".running", atom + ".begin", by + ".invoke");
        model.connector(atom + "_began", atom + ".began", by + ".serves");
        var exchange = new ArrayList<>(List.of(atom + ".exchange'"));
        for (var i = 0; i < plan.needs().size(); i++) {
            var candidates = candidates(plan.needs().get(i));
            if (candidates.contains(what.old()) && candidates.contains(what.by())) {
                exchange.add(need(i) + ".exchange_" + old);
            }
        }
        model.connector(atom + "_exchange", exchange.toArray(String[]::new));
        model.connector(atom + "_terminate", atom + ".terminate", old + ".terminate");
        model.connector(atom + "_stopped", atom + ".stopped", old + ".rests");
    }

    private void connectLifecycle(String component) {
        var name = name(component);
        model.connector(name + "_invoked", name + ".invoked");
        var fails = new ArrayList<>(List.of(name + ".fails'"));
        for (var i = 0; i < plan.needs().size(); i++) {
            if (candidates(plan.needs().get(i)).contains(component)) {
                fails.add(need(i) + ".lost_" + name);
            }
        }
        for (var i = 0; i < plan.replacements().size(); i++) {
            if (plan.replacements().get(i).by().equals(component)) {
                fails.add(replacement(i) + ".lost");
            }
        }
        model.connector(name + "_fails", fails.toArray(String[]::new));
        model.connector(name + "_terminate", APPLICATION + ".terminate", name + ".terminate");
        model.connector(name + "_terminated", name + ".terminated");
        model.connector(name + "_not_terminated", name + ".not_terminated");
    }

    private void connectTopics(String component, Component<?, ?> publisher) {
        for (var topic : publisher.publishes()) {
            var source = name(component) + "." + port(component, topic);
            var name = name(component) + "_" + port(component, topic).substring("topic_".length());
            var alone = new ArrayList<>(List.of(source + "'"));
            for (var wire : plan.wires()) {
                if (wire.from().name().equals(topic.name())) {
                    alone.add(subscriber(wire));
                }
            }
            model.connector(name, alone.toArray(String[]::new));
            for (var i = 0; i < plan.needs().size(); i++) {
                for (var candidate : candidates(plan.needs().get(i))) {
                    forward(name, source, topic, i, candidate);
                }
            }
        }
    }

    /** A value that a need forwards while it uses the candidate; it goes before a publication without the need. */
    private void forward(String name, String source, BusTopic<?> topic, int need, String candidate) {
        for (var wire : plan.wiresBetween(plan.needs().get(need).by(), candidate)) {
            if (wire.from().name().equals(topic.name())) {
                var target = subscriber(wire);
                var connector = name + "_to_" + target.replace('.', '_').replace("topic_", "") + "_" + need(need);
                model.connector(connector, source, need(need) + ".forward_" + name(candidate), target);
                model.priority(name, connector);
            }
        }
    }

    /** The port to which a wire leads. */
    private String subscriber(Wire<?> wire) {
        return plan.components().entrySet().stream()
                .filter(each -> each.getValue().subscribes().stream()
                        .anyMatch(topic -> topic.name().equals(wire.to().name())))
                .map(each -> name(each.getKey()) + "." + port(each.getKey(), wire.to()))
                .findFirst()
                .orElseThrow(() -> new IllegalArgumentException(
                        wire + " leads to a topic to which no component subscribes, expected one"));
    }

    private void connectEnd() {
        model.connector("stop", APPLICATION + ".stop");
        var closing = new ArrayList<String>();
        for (var i = 0; i < plan.needs().size(); i++) {
            closing.add(need(i));
        }
        for (var i = 0; i < plan.replacements().size(); i++) {
            closing.add(replacement(i));
        }
        for (var i = 1; i <= closing.size(); i++) {
            model.connector("close" + i, APPLICATION + ".close" + i, closing.get(i - 1) + ".close");
        }
        var finish = new ArrayList<>(List.of(APPLICATION + ".finish"));
        plan.components().keySet().forEach(component -> finish.add(name(component) + ".rests"));
        model.connector("finish", finish.toArray(String[]::new));
    }
}
