namespace LagSim.Tests.Architecture;

/// <summary>A type that may be large.</summary>
/// <param name="Type">Its full name.</param>
/// <param name="Reason">Why it is not split.</param>
/// <param name="MaxLines">The most lines it may have. More than the default is for a type that is being split.</param>
internal sealed record LargeType(string Type, string Reason, int MaxLines = LargeType.UsualMaxLines)
{
    internal const int UsualMaxLines = 600;
}
