package io.troupe.petri.wiring;

import static java.util.stream.Collectors.joining;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Callback;
import io.troupe.common.text.Suggestions;
import java.lang.reflect.Method;
import java.util.Arrays;
import java.util.Comparator;
import java.util.LinkedHashMap;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.stream.Stream;

/**
 * The methods of an actor type, and what a protocol may do with each. Overloads are one word, which may be all that one
 * of them is.
 */
final class ActorWords {
    /** What the methods of a name are. */
    private enum Word {
        REQUEST("a request", "provides"),
        STREAM("a stream of results", "streams"),
        MESSAGE("a one-way message", "receives");

        private final String what;
        private final String verb;

        Word(String what, String verb) {
            this.what = what;
            this.verb = verb;
        }
    }

    private final String protocol;
    private final Class<?> type;
    private final Map<String, List<Method>> methods;

    private ActorWords(String protocol, Class<?> type, Map<String, List<Method>> methods) {
        this.protocol = protocol;
        this.type = type;
        this.methods = methods;
    }

    static ActorWords of(String protocol, Class<?> type) {
        try {
            var methods = new LinkedHashMap<String, List<Method>>();
            ActorSpace.messages(type).stream()
                    .sorted(Comparator.comparing(ActorWords::name).thenComparing(ActorWords::signature))
                    .forEach(method -> methods.merge(name(method), List.of(method), ActorWords::both));
            return new ActorWords(protocol, type, methods);
        } catch (NoClassDefFoundError missing) {
            throw new IllegalStateException(
                    "protocol " + protocol + " is of the type " + type.getName()
                            + ", which needs troupe-actor-core on the class path, or Protocol.of(\"" + protocol
                            + "\") without a type",
                    missing);
        }
    }

    private static List<Method> both(List<Method> some, List<Method> more) {
        return Stream.concat(some.stream(), more.stream()).toList();
    }

    /** Without the mark of value classes that Kotlin's compiler adds. */
    private static String name(Method method) {
        String name = method.getName();
        int mark = name.indexOf('-');
        return mark < 0 ? name : name.substring(0, mark);
    }

    private static String signature(Method method) {
        return Arrays.stream(method.getParameterTypes())
                .map(Class::getSimpleName)
                .filter(parameter -> !parameter.equals("Continuation"))
                .collect(joining(", ", name(method) + "(", ")"));
    }

    private static Set<Word> words(Method method) {
        var words = new LinkedHashSet<Word>();
        if (method.getReturnType() != void.class) {
            words.add(Word.REQUEST); // it returns a promise, or suspends
        }
        if (Arrays.asList(method.getParameterTypes()).contains(Callback.class)) {
            words.add(Word.STREAM);
        }
        if (method.getReturnType() == void.class) {
            words.add(Word.MESSAGE); // also with a callback, if its results are no part of the wiring
        }
        return words;
    }

    /** Refuses a way out of a state whose call or message the actor does not have. */
    void require(String state, Branch branch) {
        needed(branch.kind()).ifPresent(word -> require("state " + state + " " + branch, branch.what(), word));
    }

    private static Optional<Word> needed(Branch.Kind kind) {
        return switch (kind) {
            case PROVIDES, ACCEPTS, ANSWERS, REFUSES, REJECTS -> Optional.of(Word.REQUEST);
            case STREAMS, EMITS, FINISHES -> Optional.of(Word.STREAM);
            case RECEIVES -> Optional.of(Word.MESSAGE);
            default -> Optional.empty();
        };
    }

    private void require(String what, String name, Word word) {
        var same = methods.get(name);
        if (same == null) {
            throw error(what + ", but " + type.getName() + " has no message " + name + "; "
                    + Suggestions.hintWithAll(name, methods.keySet()));
        }
        if (same.stream().noneMatch(method -> words(method).contains(word))) {
            var is = same.stream()
                    .flatMap(method -> words(method).stream())
                    .distinct()
                    .toList();
            throw error(what + ", but " + type.getName() + "." + signature(same.getFirst()) + " is "
                    + is.stream().map(each -> each.what).collect(joining(" and ")) + "; expected "
                    + is.stream().map(each -> each.verb + "(\"" + name + "\")").collect(joining(" or ")));
        }
    }

    private IllegalArgumentException error(String problem) {
        return new IllegalArgumentException("protocol " + protocol + ": " + problem);
    }
}
