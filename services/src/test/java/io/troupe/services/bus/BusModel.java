package io.troupe.services.bus;

import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import org.jspecify.annotations.Nullable;

/** A simple model of a bus: lists, without threads or promises. */
final class BusModel {
    /** The behaviour of a request handler. */
    enum Manner {
        ANSWERS,
        THROWS,
        KEEPS
    }

    /** A subscription. */
    static final class Reader {
        final List<String> heard = new ArrayList<>();
        final ArrayDeque<String> waiting = new ArrayDeque<>();
    }

    /** A request; the outcome is null while it is pending. */
    static final class Question {
        final int id;
        final String asker;
        final long deadlineSeconds;

        @Nullable
        String outcome;

        Question(int id, String asker, long deadlineSeconds) {
            this.id = id;
            this.asker = asker;
            this.deadlineSeconds = deadlineSeconds;
        }
    }

    /** A port with a request handler. */
    private static final class Answerer {
        final Manner manner;
        final ArrayDeque<Question> waiting = new ArrayDeque<>();
        final List<Question> kept = new ArrayList<>();

        Answerer(Manner manner) {
            this.manner = manner;
        }
    }

    private final int capacity;
    private final int nodes;
    private final Map<Integer, Reader> readers = new LinkedHashMap<>();
    private final Map<Integer, String> portOf = new LinkedHashMap<>();
    private final Map<String, Answerer> answerers = new LinkedHashMap<>();
    private final List<Question> questions = new ArrayList<>();
    private final Map<Integer, Reader> all = new LinkedHashMap<>();
    private final List<Question> keptByNobody = new ArrayList<>();
    long dropped;
    long discarded;
    long queued;
    long late;
    private long seconds;

    /** @param nodes the ports are distributed over this many nodes by their numbers */
    BusModel(int capacity, int nodes) {
        this.nodes = nodes;
        this.capacity = capacity;
    }

    void subscribe(int reader, String port) {
        readers.put(reader, new Reader());
        all.put(reader, readers.get(reader));
        portOf.put(reader, port);
    }

    void publish(String value) {
        for (var reader : readers.values()) {
            if (reader.waiting.size() == capacity) {
                reader.waiting.remove();
                dropped++;
            }
            reader.waiting.add(value);
            queued++;
        }
    }

    void unsubscribe(int reader) {
        var gone = readers.remove(reader);
        if (gone != null) {
            discarded += gone.waiting.size();
        }
    }

    void answer(String port, Manner manner) {
        answerers.put(port, new Answerer(manner));
    }

    void ask(int id, String asker, String to, long limitSeconds) {
        var question = new Question(id, asker, seconds + limitSeconds);
        questions.add(question);
        var answerer = answerers.get(to);
        if (answerer == null) {
            question.outcome = "refused";
        } else if (answerer.waiting.size() == capacity) {
            question.outcome = "refused";
        } else {
            answerer.waiting.add(question);
        }
    }

    void crank() {
        for (var reader : readers.values()) {
            reader.heard.addAll(reader.waiting);
            reader.waiting.clear();
        }
        for (var entry : answerers.entrySet()) {
            var answerer = entry.getValue();
            for (var question = answerer.waiting.poll(); question != null; question = answerer.waiting.poll()) {
                if (begun(entry.getKey(), answerer).size() >= capacity && isKnownToWait(question, entry.getKey())) {
                    var evicted = oldestOfAnotherNode(entry.getKey(), answerer);
                    settle(evicted == null ? question : evicted, "refused");
                    if (evicted == null) {
                        continue;
                    }
                    answerer.kept.remove(evicted);
                    keptByNobody.add(evicted);
                }
                switch (answerer.manner) {
                    case ANSWERS -> settle(question, "answered " + question.id);
                    case THROWS -> settle(question, "failed");
                    case KEEPS -> answerer.kept.add(question);
                }
            }
        }
    }

    /**
     * The begun requests of a request handler, as far as the handler's node knows: a cancelled request is removed only
     * if its requester is on the same node.
     */
    private List<Question> begun(String name, Answerer answerer) {
        return answerer.kept.stream()
                .filter(question -> isKnownToWait(question, name))
                .toList();
    }

    private @Nullable Question oldestOfAnotherNode(String name, Answerer answerer) {
        return answerer.kept.stream()
                .filter(question -> nodeOf(question.asker) != nodeOf(name))
                .findFirst()
                .orElse(null);
    }

    private boolean isKnownToWait(Question question, String answerer) {
        return question.outcome == null || nodeOf(question.asker) != nodeOf(answerer);
    }

    private int nodeOf(String port) {
        return (port.charAt(port.length() - 1) - '0') % nodes;
    }

    private void settle(Question question, String outcome) {
        if (question.outcome == null) {
            question.outcome = outcome;
        } else {
            late++;
        }
    }

    /** Replies to all requests that were kept open. */
    void answerKept() {
        for (var answerer : answerers.values()) {
            answerer.kept.forEach(question -> settle(question, "answered " + question.id));
            answerer.kept.clear();
        }
        late += keptByNobody.size();
        keptByNobody.clear();
    }

    void advance(long by) {
        seconds += by;
        for (var question : questions) {
            if (question.outcome == null && question.deadlineSeconds < seconds) {
                question.outcome = "timed out";
            }
        }
    }

    void close(String port) {
        portOf.forEach((reader, its) -> {
            if (its.equals(port)) {
                unsubscribe(reader);
            }
        });
        var answerer = answerers.remove(port);
        if (answerer != null) {
            answerer.waiting.forEach(question -> settle(question, "refused"));
            begun(port, answerer).forEach(question -> settle(question, "refused"));
            keptByNobody.addAll(answerer.kept);
        }
        for (var question : questions) {
            if (question.asker.equals(port) && question.outcome == null) {
                question.outcome = "refused";
            }
        }
    }

    Map<Integer, List<String>> heard() {
        var heard = new LinkedHashMap<Integer, List<String>>();
        all.forEach((number, reader) -> heard.put(number, reader.heard));
        return heard;
    }

    Map<Integer, String> answers() {
        var answers = new LinkedHashMap<Integer, String>();
        questions.forEach(question -> answers.put(question.id, String.valueOf(question.outcome)));
        return answers;
    }
}
