package io.troupe.actor;

import jdk.jfr.Category;
import jdk.jfr.Event;
import jdk.jfr.Label;
import jdk.jfr.Name;
import jdk.jfr.StackTrace;

/** Flight recorder event: a message was not delivered. */
@Name("io.troupe.DeadLetter")
@Label("Dead Letter")
@Category("Troupe")
@StackTrace(false)
final class DeadLetterEvent extends Event {
    @Label("Space")
    final String space;

    @Label("Receiver")
    final String receiver;

    @Label("Message")
    final String message;

    @Label("Reason")
    final String reason;

    DeadLetterEvent(String space, DeadLetter letter) {
        this.space = space;
        this.receiver = letter.actor();
        this.message = letter.message();
        this.reason = letter.reason();
    }
}
