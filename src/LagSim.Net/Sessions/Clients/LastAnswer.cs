namespace LagSim.Net.Sessions.Clients;

/// <summary>
/// What the last answer said to a client that is not let in and still asks: a refusal after which it asks again, or, in a protected
/// session, what nothing proves to be the host's. Such an answer ends nothing, and explains why none that counts has come.
/// </summary>
internal sealed class LastAnswer
{
    private string? last;
    private bool isRefusal;

    /// <summary>The last one, as a sentence to follow another; empty if there was none.</summary>
    internal string Sentence => last is null ? "" : $" {last}";

    /// <summary>The last one, if it was a refusal after which this peer asks again; else null.</summary>
    internal string? Refusal => isRefusal ? last : null;

    /// <summary>Forgets it, once the host lets this peer in.</summary>
    internal void Forget() => Note(null);

    /// <summary>Records an answer that shows the identity of another host than the one that is wanted.</summary>
    internal void NoteOtherHost() =>
        Note("An answer came from a host with another identity than this peer was told: it is another host, or somebody in between.");

    /// <summary>Records an answer that shows no identity.</summary>
    internal void NoteNoProtection() =>
        Note("An answer came from a host whose session is not protected; this peer takes part in protected sessions only.");

    /// <summary>Records a refusal that nothing proves.</summary>
    /// <param name="why">The reason it gives, as the rest of a sentence.</param>
    internal void NoteUnproven(string why) => Note($"An answer came that nothing proves to be the host's. It refuses: {why}");

    /// <summary>Records a refusal after which this peer asks again.</summary>
    /// <param name="refusal">The refusal, as a sentence.</param>
    internal void NoteRefusal(string refusal)
    {
        Note(refusal);
        isRefusal = true;
    }

    private void Note(string? sentence)
    {
        last = sentence;
        isRefusal = false;
    }
}
