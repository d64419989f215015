package io.troupe.actor;

/**
 * A message that reached nobody.
 *
 * @param actor name of the actor it was for
 * @param message the method, with its arguments
 * @param reason why it was not delivered
 */
public record DeadLetter(String actor, String message, String reason) {
    @Override
    public String toString() {
        return message + " to " + actor + ": " + reason;
    }
}
