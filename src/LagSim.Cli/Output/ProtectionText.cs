namespace LagSim.Cli.Output;

/// <summary>What the titles of experiments say of a session's protection.</summary>
internal static class ProtectionText
{
    /// <summary>The words behind the name of the carrier.</summary>
    internal static string Of(bool isProtected) => isProtected ? ", protected" : ", NOT PROTECTED";
}
