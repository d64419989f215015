package io.troupe.actor.soak;

import io.troupe.actor.promise.Promise;
import java.time.Duration;
import java.util.ArrayDeque;
import java.util.List;
import java.util.concurrent.TimeoutException;
import java.util.function.Consumer;

/**
 * A thread that sends numbered messages to every sink in turn.
 *
 * <p><b>Order.</b> After each window of messages it requests from a sink the number that has arrived. The result must
 * be exactly the number sent, because the request was queued behind the messages. The producer waits for the result of
 * the previous request first, so at most two windows of its messages are queued.
 */
final class Producer implements Runnable {
    private static final Duration PATIENCE = Duration.ofSeconds(60);
    private static final int QUESTIONS_OPEN = 1;

    private record Question(Sink sink, long sent, Promise<Long> taken) {}

    private final int number;
    private final long messagesPerSink;
    private final int window;
    private final List<Sink> sinks;
    private final List<Sink> paced;
    private final Consumer<String> fault;
    private final ArrayDeque<Question> open = new ArrayDeque<>();

    /**
     * Creates a producer.
     *
     * @param paced those sinks that have no other means of slowing it down
     */
    Producer(int number, long messagesPerSink, int window, List<Sink> sinks, List<Sink> paced, Consumer<String> fault) {
        this.number = number;
        this.messagesPerSink = messagesPerSink;
        this.window = window;
        this.sinks = sinks;
        this.paced = paced;
        this.fault = fault;
    }

    @Override
    public void run() {
        try {
            for (long message = 0; message < messagesPerSink; message++) {
                for (Sink sink : sinks) {
                    sink.take(number, message);
                }
                if ((message + 1) % window == 0) {
                    ask(paced, message + 1);
                    check(QUESTIONS_OPEN * paced.size());
                }
            }
            ask(sinks, messagesPerSink);
            check(0);
        } catch (TimeoutException late) {
            fault.accept("producer " + number + ": " + late.getMessage());
        } catch (InterruptedException stopped) {
            fault.accept("producer " + number + " was interrupted");
        } catch (RuntimeException refused) {
            fault.accept("producer " + number + ": " + refused);
        }
    }

    private void ask(List<Sink> asked, long sent) {
        asked.forEach(sink -> open.add(new Question(sink, sent, sink.taken(number))));
    }

    private void check(int mayStayOpen) throws TimeoutException, InterruptedException {
        while (open.size() > mayStayOpen) {
            Question question = open.remove();
            long taken = question.taken.get(PATIENCE);
            if (taken != question.sent) {
                fault.accept("producer %d had sent %,d messages to %s, and %,d had arrived"
                        .formatted(number, question.sent, question.sink, taken));
            }
        }
    }
}
