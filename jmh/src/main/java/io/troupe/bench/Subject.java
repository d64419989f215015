package io.troupe.bench;

import org.jspecify.annotations.Nullable;

/** A contender, with the helpers that some workloads need. */
final class Subject implements AutoCloseable {
    private final Contender contender;
    private final FourSenders four = new FourSenders();
    private @Nullable Families families;

    Subject(Contender contender) {
        this.contender = contender;
    }

    Contender contender() {
        return contender;
    }

    void tell(int messages) throws Exception {
        contender.tell(messages, Senders.ONE);
    }

    void tellFromFour(int messages) throws Exception {
        contender.tell(messages, four);
    }

    void tellOfMany(int messages) throws Exception {
        families().tell(messages);
    }

    /**
     * Creates the families as late as possible: code compiled after two hundred message types were met is slower than
     * code compiled after ten.
     */
    Families families() throws Exception {
        if (families == null) {
            families = new Families(contender);
        }
        return families;
    }

    @Override
    public void close() {
        four.close();
        contender.close();
    }
}
