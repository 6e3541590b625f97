namespace LagSim.Net.Sessions.Clients;

/// <summary>
/// What answers said to a client that wants a protected session, and nothing proved: they may be the host's, or anybody's on the path. So
/// they end nothing, and only explain why no answer that counts has come.
/// </summary>
internal sealed class UnprovenAnswers
{
    private string? last;

    /// <summary>The last one, as a sentence to follow another; empty if there was none.</summary>
    internal string Sentence => last is null ? "" : $" {last}";

    /// <summary>Forgets them, once the host has proved itself.</summary>
    internal void Forget() => last = null;

    /// <summary>Records an answer that shows the identity of another host than the one that is wanted.</summary>
    internal void NoteOtherHost() =>
        last = "An answer came from a host with another identity than this peer was told: it is another host, or somebody in between.";

    /// <summary>Records an answer that shows no identity.</summary>
    internal void NoteNoProtection() =>
        last = "An answer came from a host whose session is not protected; this peer takes part in protected sessions only.";

    /// <summary>Records a refusal.</summary>
    /// <param name="why">The reason it gives, as the rest of a sentence.</param>
    internal void NoteRefusal(string why) => last = $"An answer came that nothing proves to be the host's. It refuses: {why}";
}
