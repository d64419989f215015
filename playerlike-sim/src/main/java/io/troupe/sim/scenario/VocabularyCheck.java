package io.troupe.sim.scenario;

import java.util.Collection;
import java.util.TreeSet;

/** Holds a tree against the {@link Vocabulary}: unknown names, wrong kinds of value, entities in the wrong place. */
final class VocabularyCheck {
    private final Document document;

    private VocabularyCheck(Document document) {
        this.document = document;
    }

    /**
     * Throws at the first thing that is not in the vocabulary. Macros are checked too; what is known but not supported
     * yet is an error only where a macro is used, so that stock include files with more in them than a world needs
     * can be read.
     */
    static void check(Document document) {
        var check = new VocabularyCheck(document);
        for (Entity macro : document.macros().values()) {
            if (!Vocabulary.isType(macro.type())) {
                throw check.unknownType(macro, Vocabulary.readableTypes());
            }
            if (!Vocabulary.isLater(macro.type())) {
                check.inside(macro, false);
            }
        }
        check.inside(document.root(), true);
    }

    private void inside(Entity entity, boolean used) {
        Vocabulary.Type type = Vocabulary.type(entity.type());
        for (Property property : entity.properties().values()) {
            property(property, entity, type, used);
        }
        for (Entity child : entity.children()) {
            if (mayRead(child, entity, type, used)) {
                inside(child, used);
            }
        }
    }

    private static void property(Property property, Entity entity, Vocabulary.Type type, boolean used) {
        PropertyRule rule = type.properties().get(property.name());
        if (rule == null) {
            throw new WorldFileException(
                    property.where(),
                    "unknown property \"" + property.name() + "\" of " + entity.type()
                            + Suggestions.briefly(
                                    property.name(), type.properties().keySet()));
        }
        if (!rule.refusal().isEmpty()) {
            if (used) {
                throw new WorldFileException(property.where(), "\"" + property.name() + "\" " + rule.refusal());
            }
            return;
        }
        rule.check(property);
    }

    /** False for what an unused macro holds and we do not read yet. */
    private boolean mayRead(Entity child, Entity parent, Vocabulary.Type parentType, boolean used) {
        String refusal = parentType.children().get(child.type());
        if ("".equals(refusal)) {
            return true;
        }
        if (refusal != null || Vocabulary.isLater(child.type())) {
            if (used) {
                throw new WorldFileException(
                        child.where(),
                        refusal != null
                                ? refusal
                                : "\"" + child.type()
                                        + "\" is not supported yet: this version reads model, position, ranger and"
                                        + " blobfinder");
            }
            return false;
        }
        if (Vocabulary.isType(child.type())) {
            throw new WorldFileException(
                    child.where(),
                    "\"" + child.type() + "\" cannot stand in a " + parent.type() + "; it belongs in a "
                            + String.join(" or a ", Vocabulary.holdersOf(child.type())));
        }
        throw unknownType(child, parentType.readableChildren());
    }

    private WorldFileException unknownType(Entity entity, Collection<String> builtIn) {
        var known = new TreeSet<>(builtIn);
        known.addAll(document.macros().keySet());
        return new WorldFileException(
                entity.where(), "unknown entity \"" + entity.type() + '"' + Suggestions.briefly(entity.type(), known));
    }
}
